"""A mobility near a no-slip plane: that of unbounded fluid, and the wall's correction."""

import numpy as np

from sedfiber._typing import Band, Matrix, Positions
from sedfiber.physics.free_draining import add_band
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.wall import WallCorrection


class NearWall:
    """``M(x) = M_RPY(x) + ΔM(x)`` (Swan & Brady 2007); depends on the place, so needs laboratory positions."""

    placed = True

    def __init__(self, free: PairMobility, wall: WallCorrection):
        self.free, self.wall = free, wall

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
        correction, force_jac = np.zeros((size, size)), np.zeros((size, size))
        self.wall.add_matrix(x, correction)
        add_band(band, force_jac)
        jac[:size, :size] += correction @ force_jac
        self.wall.add_gradient(x, force, jac)
