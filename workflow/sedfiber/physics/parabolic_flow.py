"""The parabolic profile of a flow driven by pressure between two planes, here without the planes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sedfiber.core.array_types import Array, Matrix, Positions
from sedfiber.physics.kernel import kernel


@dataclass(frozen=True)
class ParabolicFlow:
    """``u = P (1 − y²/H²) x̂``: fastest, ``P`` in ``U_s``, at y = 0 and zero at y = ±H (in a).

    Unbounded: no wall stands at ±H, and beyond the flow turns back.  A bead is carried at the
    mean of ``u`` over its surface, which by Faxén's law is ``(1 + ∇²/6) u`` at its centre: less than
    the fluid there by ``P/(3H²)``, everywhere.  Rates of strain need no such term, being linear in y.
    """

    peak: float
    half_width: float

    @cached_property
    def strain(self) -> tuple[Array, float]:
        """Zero at y = 0, and the slope of ``E_xy = −P y/H²`` with y: see ``StrainingFlow``."""
        return np.zeros((3, 3)), -self.peak / self.half_width**2

    def add_velocity(self, x: Positions, u: Positions) -> None:
        """Add the velocity of freely carried beads to ``u``, shape (N, d)."""
        _add_velocity(x, self.peak, self.half_width, u)

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``∂u_x/∂y = −2 P y/H²`` of each bead to ``jac``, at least (N d, N d)."""
        _add_jacobian(x, self.peak, self.half_width, jac)


@kernel()
def _add_velocity(x, peak, half_width, u):
    over = 1.0 / (half_width * half_width)
    for i in range(x.shape[0]):
        u[i, 0] += peak * (1.0 - over * (x[i, 1] * x[i, 1] + 1.0 / 3.0))


@kernel()
def _add_jacobian(x, peak, half_width, jac):
    n, d = x.shape
    for i in range(n):
        jac[i * d, i * d + 1] -= 2.0 * peak * x[i, 1] / (half_width * half_width)
