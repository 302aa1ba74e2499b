"""Units of the reduced-order model: lengths in L/2, ℬ as a scaled logarithm.

X̌ = (X − c)/(L/2) − X̄_term/(L/2),        L/2 = N a
b = 2 (ln ℬ − ln ℬ_min)/(ln ℬ_max − ln ℬ_min) − 1,    with ℬ_min, ℬ_max of the training data
"""

from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.reduced.dataset import Dataset, SettlingFall


@dataclass(frozen=True)
class Scales:
    """Scales that turn data into network inputs; taken from the training data only."""

    n_beads: int
    B_min: float
    B_max: float
    theta0_max: float

    @classmethod
    def of(cls, training: Dataset) -> "Scales":
        """Scales of a training set."""
        values = training.B_values
        steepest = max(abs(trajectory.theta0) for trajectory in training)
        return cls(training.n_beads, float(values[0]), float(values[-1]), float(steepest))

    @property
    def half_length(self) -> float:
        """L/2 in units of ``a``."""
        return float(self.n_beads)

    def log_B(self, B: Array | float) -> Array:
        """Scaled logarithm ``b``, in [−1, 1] within the training range; shape of ``B``."""
        if self.B_max == self.B_min:
            return np.log(np.asarray(B, dtype=float) / self.B_min)
        span = np.log(self.B_max / self.B_min)
        return 2.0 * np.log(np.asarray(B, dtype=float) / self.B_min) / span - 1.0

    def residual(self, positions: Array, terminal: Array) -> Array:
        """Residual shapes X̌ in units of L/2; ``positions`` (…, N, 3) gives (…, 3N)."""
        centre = positions[..., self.n_beads // 2, None, :]
        residual = (positions - centre - terminal) / self.half_length
        return residual.reshape(*residual.shape[:-2], -1)

    def shape(self, residual: Array, terminal: Array) -> Array:
        """Positions relative to the centre bead, in ``a``: (…, 3N) gives (…, N, 3)."""
        shape = residual.reshape(*residual.shape[:-1], self.n_beads, 3)
        return shape * self.half_length + terminal

    def centre(self, positions: Array) -> Array:
        """Centre bead in units of L/2, shape (…, 3)."""
        return positions[..., self.n_beads // 2, :] / self.half_length

    def covers(self, B: float, theta0: float) -> bool:
        """Whether a forecast at ``B`` and ``theta0`` stays within the training range."""
        slack = 1e-9
        inside = self.B_min * (1 - slack) <= B <= self.B_max * (1 + slack)
        return bool(inside and abs(theta0) <= self.theta0_max + slack)

    def nearest_B(self, B: float) -> float:
        """The ℬ of the training range that is nearest to ``B``: ``B`` itself within it."""
        return min(max(B, self.B_min), self.B_max)


def residual_history(trajectory: SettlingFall, scales: Scales) -> Array:
    """Residual shapes of one trajectory, shape (T, 3N), units L/2."""
    return scales.residual(trajectory.positions, trajectory.terminal)
