"""The record of an integration, in the coordinates that settling, checks and audit use."""

from dataclasses import dataclass

from sedfiber.core.array_types import History, State, Times
from sedfiber.physics.mirror import MirrorSymmetric
from sedfiber.physics.system import System


@dataclass(frozen=True)
class Run:
    """Samples at ``t`` (T,) in a/U_s: ``states`` (T, size) of the system, and all beads in a, (T, beads, 3).

    ``shapes`` are relative to the centre bead, ``positions`` in the laboratory.
    """

    t: Times
    states: State
    shapes: History
    positions: History

    @classmethod
    def of(cls, system: System | MirrorSymmetric, t: Times, states: State) -> "Run":
        """The run through ``states`` (T, size) of ``system``."""
        return cls(t, states, system.to_shapes(states), system.to_positions(states))

    def until(self, count: int) -> "Run":
        """The first ``count`` samples."""
        return Run(self.t[:count], self.states[:count], self.shapes[:count], self.positions[:count])
