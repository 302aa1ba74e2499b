"""Rotne–Prager–Yamakawa mobility, with or without its form for overlapping beads."""

from dataclasses import dataclass

import numpy as np

from sedfiber._typing import Matrix, Positions
from sedfiber.physics import pair_mobility


@dataclass(frozen=True)
class RotnePragerYamakawa:
    """Far-field mobility of equal spheres to order ``(a/r)³``, in units ``1/(6πμa)``.

    ``overlap=False`` is the form that Fox & Graham 2024 print, used at every distance;
    it loses positive definiteness when beads overlap enough.  ``overlap=True`` switches
    to Yamakawa's form below ``r = 2``, positive definite in every configuration.
    """

    overlap: bool = False

    def velocity(self, x: Positions, force: Positions) -> Positions:
        """``u = M(x) F``, shape (N, d)."""
        u = np.zeros_like(x)
        pair_mobility.add_pair_velocities(x, force, self.overlap, u)
        return u

    def matrix(self, x: Positions) -> Matrix:
        """``M(x)``, shape (N d, N d), symmetric."""
        m = np.empty((x.size, x.size))
        pair_mobility.fill_mobility(x, self.overlap, m)
        return m

    def jacobian(self, x: Positions, force: Positions, force_jac: Matrix) -> Matrix:
        """``∂(M F)/∂x = M ∂F/∂x + (∂M/∂x) F``, shape (N d, N d)."""
        jac = self.matrix(x) @ force_jac
        pair_mobility.add_mobility_gradient(x, force, self.overlap, jac)
        return jac
