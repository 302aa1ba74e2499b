"""One fall of one scene, from its start over so many samples, integrated and nothing else."""

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields
from functools import cached_property, partial

import numpy as np

from sedfiber.core.array_types import History, Positions, State, Times
from sedfiber.physics.integrators import Counters, Integrator
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene

COUNTED = [field.name for field in fields(Counters)]  # columns of whole numbers


class OutOfTime(Exception):
    """A run has used up its seconds at time ``t`` of the fall."""

    def __init__(self, t: float):
        super().__init__(f"too long at t = {t:.6g} a/U_s")
        self.t = t


@dataclass(frozen=True)
class Integrated:
    """Positions (T, N, 3) of all samples, or of the first where a run stopped before the end, and its counters."""

    positions: History
    counters: Counters

    @property
    def columns(self) -> dict[str, int]:
        """``steps``, ``rhs``, ``jacobians`` and ``factorisations``."""
        return asdict(self.counters)


@dataclass(frozen=True)
class FallProblem:
    """The problem to integrate: ``samples`` states of ``scene``, every ``interval`` a/U_s from its start."""

    scene: Scene
    samples: int
    interval: float = Numerics.interval

    @cached_property
    def times(self) -> Times:
        """Times of the samples in a/U_s."""
        return self.interval * np.arange(self.samples)

    @cached_property
    def system(self) -> System:
        """One that no run counts on, to time and to convert states with."""
        return assemble(self.scene)

    @cached_property
    def start(self) -> State:
        """The state that all runs begin with."""
        return self.system.to_state(self.scene.start())

    @property
    def start_positions(self) -> Positions:
        """The same as positions (N, 3)."""
        return self.system.to_positions(self.start)

    @property
    def rhs(self) -> Callable[[], State]:
        """A call of one right-hand side, at the start: the unit of cost."""
        return partial(self.system.rhs, 0.0, self.start)

    def by_integrator(self, integrator: Integrator, seconds: float = np.inf) -> Integrated:
        """All samples; raises OutOfTime, looking at the clock after each."""
        deadline = time.perf_counter() + seconds
        states = []
        for y in integrator.states(self.start, self.interval):
            states.append(y)
            if len(states) == self.samples:
                break
            if time.perf_counter() > deadline:
                raise OutOfTime((len(states) - 1) * self.interval)
        return Integrated(self.system.to_positions(np.array(states)), integrator.counters)

    def by_numerics(self, numerics: Numerics) -> Integrated:
        """The integrator of ``numerics`` on a system of its own."""
        return self.by_integrator(numerics.integrator_for(assemble(self.scene), self.scene))
