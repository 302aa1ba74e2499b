"""The base of all integrators: each yields equally spaced samples."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite

import numpy as np

from sedfiber.core.array_types import State
from sedfiber.core.errors import NumericalError
from sedfiber.physics.protocols import Equations

MOST_STEPS = 20_000  # in one sample
# of the sampling interval, and in a/U_s; left to itself, LSODA jumps to the end where nothing moves at first
FIRST_STEP, LONGEST_FIRST = 1e-4, 5e-5


@dataclass(frozen=True)
class Tolerances:
    """Local error per step: ``atol + rtol |y|``, ``atol`` in units of a."""

    rtol: float
    atol: float


@dataclass
class Counters:
    """Counts of an integration's work, equal on every machine."""

    steps: int = 0
    rhs: int = 0
    jacobians: int = 0
    factorisations: int = 0


class Integrator(ABC):
    """States at ``t = 0, τ, 2τ, …`` for as long as the caller asks for more.

    A subclass sets ``name`` and writes ``states``.  A step that fails, or a state that is
    not finite, raises NumericalError: no solver's own success flag is trusted alone.
    """

    name: str

    def __init__(self, system: Equations, tolerances: Tolerances):
        self.system = system
        self.tolerances = tolerances
        self.counters = Counters()

    @abstractmethod
    def states(self, start: State, interval: float) -> Iterator[State]:
        """Yield the start, then the state after each further ``interval``."""

    def failed(self, t: float, why: str, advice: str) -> NumericalError:
        """The error for an integration that stops at time ``t``."""
        return NumericalError(f"{self.name}: {why} at t = {t:.6g} a/U_s; {advice}")

    def stuck(self, t: float, y: State, why: str, advice: str) -> NumericalError:
        """The error for steps that fail at state ``y``: where beads collapsed, or are in a wall, that is why."""
        return self.failed(t, *(self.system.loss_of_definiteness(y) or (why, advice)))

    def require_finite(self, t: float, y: State) -> State:
        """``y`` itself, or NumericalError when a coordinate is NaN or infinite."""
        # the square first: it is cheap, and finite for all but the absurd
        if not isfinite(y.dot(y)) and not np.isfinite(y).all():
            raise self.failed(t, "a bead position is not finite", "try a smaller --rtol")
        return y
