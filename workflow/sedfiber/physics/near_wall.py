"""A mobility near a no-slip plane: that of unbounded fluid, and the wall's correction."""

import numpy as np

from sedfiber.core.array_types import Band, Matrix, Positions
from sedfiber.physics.kernel import kernel
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.wall import WallCorrection


class NearWall:
    """``M(x) = M_RPY(x) + ΔM(x)`` (Swan & Brady 2007); depends on the place, so needs laboratory positions.

    ``has_contact`` says whether a force keeps beads off the wall; it is for the advice where one got into it.
    """

    needs_lab_frame = True

    def __init__(self, free: PairMobility, wall: WallCorrection, has_contact: bool = False):
        self.free, self.wall, self.has_contact = free, wall, has_contact

    def velocity(self, x: Positions, force: Positions, u: Positions) -> None:
        """Write ``M(x) F`` to ``u``, shape (N, 3)."""
        self.free.velocity(x, force, u)
        self.wall.add_velocity(x, force, u)

    def matrix(self, x: Positions) -> Matrix:
        """``M(x)``, shape (3N, 3N), symmetric."""
        m = self.free.matrix(x)
        self.wall.add_matrix(x, m)
        return m

    def linearise(self, x: Positions, force: Positions, band: Band, u: Positions, jac: Matrix) -> None:
        """Write ``M F`` to ``u`` and add ``M ∂F/∂x + (∂M/∂x) F`` to ``jac``, at least (3N, 3N)."""
        size = x.size
        self.free.linearise(x, force, band, u, jac)
        self.wall.add_velocity(x, force, u)
        correction = np.zeros((size, size))
        self.wall.add_matrix(x, correction)
        _add_product(correction, band, jac)
        self.wall.add_gradient(x, force, jac)


@kernel()
def _add_product(m: Matrix, band: Band, jac: Matrix) -> None:
    """Add ``m ∂F/∂x`` to ``jac``, at least (N d, N d), for a banded ``∂F/∂x``."""
    reach, d, n = band.shape[0] // 2, band.shape[1], band.shape[3]
    for r in range(n * d):
        for j in range(n):
            for i in range(max(0, j - reach), min(n, j + reach + 1)):
                for w in range(d):
                    for v in range(d):
                        jac[r, j * d + w] += m[r, i * d + v] * band[i - j + reach, v, w, j]
