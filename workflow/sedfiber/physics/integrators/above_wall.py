"""An integrator that ends where a bead is in the wall: from there on solvers creep for minutes before they give up."""

from collections.abc import Iterator

from sedfiber.core.array_types import State
from sedfiber.physics.definiteness import wall_blame
from sedfiber.physics.integrators.base import Integrator
from sedfiber.physics.protocols import BeadEquations


class AboveWall(Integrator):
    """``integrator`` near a wall, with each of its samples looked at."""

    def __init__(self, integrator: Integrator, system: BeadEquations):
        super().__init__(system, integrator.tolerances)
        self._beads, self._integrator = system, integrator
        self.name, self.counters = integrator.name, integrator.counters

    def states(self, start: State, interval: float) -> Iterator[State]:
        for k, y in enumerate(self._integrator.states(start, interval)):
            if blame := wall_blame(self._beads.mobility, self._beads.to_positions(y)):
                raise self.failed(k * interval, *blame)
            yield y
