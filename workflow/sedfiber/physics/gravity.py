"""Gravity: a constant force on each bead."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sedfiber.core.array_types import Band, Positions
from sedfiber.physics.kernel import kernel


@dataclass(frozen=True)
class Gravity:
    """The weight of each bead, ``g``; the study's is ``−ŷ``, the unit of force ``6πμaU_s``.

    In the plane its third component must be zero.
    """

    weight: tuple[float, float, float] = (0.0, -1.0, 0.0)

    needs_lab_frame: ClassVar[bool] = False
    banded: ClassVar[bool] = True

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the weight to every row of ``force``, shape (N, d)."""
        gx, gy, gz = self.weight
        _add_force(gx, gy, gz, force)

    def add_jacobian(self, x: Positions, jac: Band) -> None:
        """A constant force has no derivative."""

    def energy(self, x: Positions) -> float:
        """``−Σ g·x`` in units of ``6πμaU_s · a``."""
        return -float(x.sum(axis=0) @ np.array(self.weight[: x.shape[1]]))


@kernel()
def _add_force(gx, gy, gz, force):
    for i in range(force.shape[0]):
        force[i, 0] += gx
        force[i, 1] += gy
        if force.shape[1] == 3:
            force[i, 2] += gz
