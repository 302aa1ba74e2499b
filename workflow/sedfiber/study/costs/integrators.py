"""Work against precision: what each integrator takes for the whole fall of one fiber of the study.

Methods that take several times as long as the default are run at every second or every fourth
tolerance (see METHODS).  A run that fails, takes too long, or reports success and is
wrong, is a row that says so with the seconds it took.
"""

import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from sedfiber.core.array_types import History
from sedfiber.core.errors import NumericalError
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.study.angles import angle_of
from sedfiber.study.costs.fall_problem import COUNTED, FallProblem, Integrated, OutOfTime
from sedfiber.study.costs.machine import machine_columns
from sedfiber.study.costs.methods import ANALYTIC, METHODS, Method, by_ours
from sedfiber.study.costs.timing import timed_run

TOLERANCES = tuple(10.0**-k for k in range(2, 11))  # rtol, and atol in a
LIMIT = 5.0  # s: a run that takes longer is left out
SOURCE_LIMIT = 30.0  # s: the paper's set-up goes as far through the fall as this
REFERENCE = 1e-12  # tolerance of the references
_WRONG = 0.1  # of L: an error that no tolerance asks for
_UNCOUNTED = dict.fromkeys((*COUNTED, "rhs_units"), float("nan"))


def measure_integrators(
    B: float,
    angle_index: int,
    tolerances: tuple[float, ...] = TOLERANCES,
    limit: float = LIMIT,
    source_limit: float = SOURCE_LIMIT,
    n_beads: int = Scene.n_beads,
) -> list[dict[str, Any]]:
    """A row for each method and tolerance: error, time, and what was counted.

    The fall ends with the first sample after the settling time.  ``error`` is the largest
    root-mean-square bead distance over L at any sample from a run of another method at 1e-12, and
    ``reference_agreement`` that of the two references from each other.  ``rhs_units`` is the least
    time in right-hand sides of the same scene, timed turn about.  ``fraction_of_fall`` is the part
    that was integrated; ``seconds_whole_fall`` scales the least time up to the whole.
    """
    scene = Scene(B, angle_of(angle_index), n_beads)
    fall = FallProblem(scene, len(simulate(scene).t))
    references = _References.of(fall)
    facts = {"B": scene.B, "angle_index": angle_index, "theta0": scene.theta0}
    ends = {"reference_agreement": references.agreement, **machine_columns()}
    rows = []
    for method in METHODS:
        seconds = limit if method.own_tolerance is None else source_limit
        rows += [facts | row | ends for row in _rows(method, fall, references, tolerances, seconds)]
    return rows


@dataclass(frozen=True)
class _References:
    """Positions by Radau, by whichever of LSODA and BDF is nearer to it, and how far the two are apart."""

    radau: History
    other: History
    agreement: float

    @classmethod
    def of(cls, fall: FallProblem) -> "_References":
        runs = {name: by_ours(name, ANALYTIC, fall, REFERENCE, float("inf")) for name in ("Radau", "LSODA", "BDF")}
        radau, *others = (run.positions for run in runs.values())
        apart = [largest_distance(radau, other, fall.scene.length) for other in others]
        return cls(radau, others[apart.index(min(apart))], min(apart))

    def error(self, method: Method, fall: FallProblem, run: Integrated) -> float:
        """The error of a run over its samples; never measured against its own method."""
        reference = self.other if method.name == "Radau" else self.radau
        return largest_distance(run.positions, reference[: len(run.positions)], fall.scene.length)


def _rows(
    method: Method, fall: FallProblem, references: _References, tolerances: tuple[float, ...], seconds: float
) -> Iterator[dict[str, Any]]:
    """Rows from the loosest tolerance on; once a run takes too long, tighter ones are not tried."""
    too_long = None
    for tolerance in method.ladder(list(tolerances)):
        head = {"method": method.name, "jacobian": method.jacobian, "tolerance": tolerance}
        if too_long is not None:
            yield head | _omitted(f"not tried: takes too long already at {too_long:.0e}")
            continue
        begun = time.perf_counter()
        try:
            yield head | _measured(method, fall, references, tolerance, seconds)
        except OutOfTime as stop:
            too_long = tolerance
            part = stop.t / fall.times[-1]
            yield head | _omitted(f"takes longer than {seconds:g} s", time.perf_counter() - begun, part)
        except (NumericalError, ValueError) as error:  # SciPy's solvers meet infinities with a ValueError
            yield head | _omitted(str(error), time.perf_counter() - begun)


def _measured(
    method: Method, fall: FallProblem, references: _References, tolerance: float, seconds: float
) -> dict[str, Any]:
    timing = timed_run(lambda: method.integrate(fall, tolerance, seconds), fall.rhs)
    run: Integrated = timing.returned
    part = (len(run.positions) - 1) / (fall.samples - 1)
    counts = run.columns | {"rhs_units": timing.units}
    whole = {"fraction_of_fall": part, "seconds_whole_fall": timing.least / part}
    error = references.error(method, fall, run)
    status = "ok" if error < _WRONG else f"reports success, but is off by more than {_WRONG:g} L"
    return {"error": error} | timing.columns | counts | whole | {"status": status}


def _omitted(why: str, seconds: float = float("nan"), part: float = float("nan")) -> dict[str, Any]:
    """A run without a result, the seconds spent on it, and the part of the fall they were enough for."""
    spent = {"seconds_least": seconds, "seconds_median": seconds, "seconds_spread": float("nan"), "repeats": 0}
    whole = {"fraction_of_fall": part, "seconds_whole_fall": seconds / part if part else float("nan")}
    return {"error": float("nan")} | spent | _UNCOUNTED | whole | {"status": why}
