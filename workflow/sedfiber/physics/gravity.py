"""Gravity: the weight of one bead, ``−ŷ``, on each bead."""

from dataclasses import dataclass

from sedfiber._typing import Matrix, Positions


@dataclass(frozen=True)
class Gravity:
    """A constant force ``−ŷ`` per bead; forces are measured in this weight, ``6πμaU_s``."""

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add ``−ŷ`` to every row of ``force``, shape (N, d)."""
        force[:, 1] -= 1.0

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """A constant force has no derivative."""

    def energy(self, x: Positions) -> float:
        """``Σ y`` in units of ``6πμaU_s · a``."""
        return float(x[:, 1].sum())
