"""A way to an answer, and what it took on every test trajectory."""

from dataclasses import asdict, dataclass, field

import numpy as np

from sedfiber.core.array_types import Array

SIMULATION, FORECAST, LOOKUP, GALERKIN = "simulation", "forecast", "lookup", "POD-Galerkin"
TORCH = " (torch)"  # after the name of a model that is not in compiled code


@dataclass(frozen=True)
class Choice:
    """A way to a trajectory: ``name`` within a ``family``, and its settings.

    ``tolerance`` is relative and absolute alike (NaN where there is none), ``batch`` the number of
    trajectories asked for at once, ``dimension`` the number of unknowns of a shape.
    """

    family: str
    name: str
    dimension: int
    tolerance: float = float("nan")
    batch: int = 1
    precision: str = "float64"


@dataclass
class Outcome:
    """The outcome of one choice over its queries: arrays (R,) with NaN for a query that failed.

    ``error`` is the largest root-mean-square bead distance over L, ``E`` the largest E(t); seconds
    are those of one trajectory; ``evaluations`` are right-hand sides of the fiber for a simulation,
    and of the neural ODE for a forecast, with ``decoded`` shapes beside them.
    """

    choice: Choice
    rows: list[dict[str, float]] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)

    def column(self, name: str) -> Array:
        """One number of every query."""
        return np.array([row.get(name, np.nan) for row in self.rows], dtype=float)

    @property
    def facts(self) -> dict[str, object]:
        """The choice as columns."""
        return asdict(self.choice)


NOTHING = {"error": np.inf, "E": np.inf, "seconds_least": np.nan}  # of a query that failed


class Outcomes:
    """All outcomes of one run of the measurement, by choice, in the order in which they came up."""

    def __init__(self) -> None:
        self._found: dict[Choice, Outcome] = {}

    def add(self, choice: Choice, row: dict[str, float]) -> None:
        """The next query's numbers."""
        self._outcome(choice).rows.append(row)

    def fail(self, choice: Choice, why: str) -> None:
        """The next query failed."""
        outcome = self._outcome(choice)
        outcome.rows.append(NOTHING)
        outcome.failures.append(why)

    def all(self) -> list[Outcome]:
        """In order."""
        return list(self._found.values())

    def family(self, name: str) -> list[Outcome]:
        """The choices of one family."""
        return [outcome for choice, outcome in self._found.items() if choice.family == name]

    def _outcome(self, choice: Choice) -> Outcome:
        return self._found.setdefault(choice, Outcome(choice))
