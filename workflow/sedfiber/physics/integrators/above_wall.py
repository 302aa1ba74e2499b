"""A march that ends where a bead is in the wall: from there on solvers creep for minutes before they give up."""

from collections.abc import Iterator

from sedfiber.core.array_types import State
from sedfiber.physics.definiteness import wall_blame
from sedfiber.physics.integrators.base import March


class AboveWall(March):
    """``march`` near a wall, with each of its samples looked at."""

    def __init__(self, march: March):
        super().__init__(march.system, march.tolerances)
        self._march, self.name, self.counters = march, march.name, march.counters

    def states(self, start: State, interval: float) -> Iterator[State]:
        for k, y in enumerate(self._march.states(start, interval)):
            if blame := wall_blame(self.system.mobility, self.system.to_positions(y)):
                raise self.failed(k * interval, *blame)
            yield y
