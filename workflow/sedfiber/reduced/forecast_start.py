"""The start of a forecast, without torch."""

from dataclasses import dataclass

from sedfiber.core.array_types import Array, Positions
from sedfiber.reduced.dataset import SettlingFall


@dataclass(frozen=True)
class Start:
    """The start of a forecast: ``initial`` positions (N, 3), and the steady state at ℬ.

    ``terminal`` (N, 3) is relative to the centre bead, ``terminal_velocity`` has shape (3,).
    ``nearest`` is the nearest trained ℬ with its terminal shape, where ℬ is outside the
    training range; without it the networks see ℬ itself.
    """

    B: float
    initial: Positions
    terminal: Positions
    terminal_velocity: Array
    nearest: tuple[float, Positions] | None = None

    @property
    def pace(self) -> float:
        """Factor on dh/dt: ℬ/ℬ* below the training range, else 1."""
        return 1.0 if self.nearest is None else min(1.0, self.B / self.nearest[0])

    @classmethod
    def of(cls, trajectory: SettlingFall) -> "Start":
        """The start of a stored trajectory: its first sample and its steady state."""
        return cls(trajectory.B, trajectory.positions[0], trajectory.terminal, trajectory.terminal_velocity)
