"""No hydrodynamic interaction: each bead is dragged through the fluid as if it were alone."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sedfiber.core.array_types import Band, Matrix, Positions
from sedfiber.physics.kernel import kernel


@dataclass(frozen=True)
class FreeDraining:
    """``M = I`` in units ``1/(6πμa)`` (Stokes drag)."""

    needs_lab_frame: ClassVar[bool] = False

    def velocity(self, x: Positions, force: Positions, u: Positions) -> None:
        """Write ``F`` to ``u``, shape (N, d)."""
        u[:] = force

    def matrix(self, x: Positions) -> Matrix:
        """The unit matrix, shape (N d, N d)."""
        return np.eye(x.size)

    def linearise(self, x: Positions, force: Positions, band: Band, u: Positions, jac: Matrix) -> None:
        """Write ``F`` to ``u`` and add ``∂F/∂x`` to ``jac``, at least (N d, N d)."""
        u[:] = force
        add_band(band, jac)


@kernel()
def add_band(band: Band, jac: Matrix) -> None:
    """Add a band to a matrix, at least (N d, N d)."""
    reach, d, n = band.shape[0] // 2, band.shape[1], band.shape[3]
    for j in range(n):
        for i in range(max(0, j - reach), min(n, j + reach + 1)):
            for k in range(d):
                for w in range(d):
                    jac[i * d + k, j * d + w] += band[i - j + reach, k, w, j]
