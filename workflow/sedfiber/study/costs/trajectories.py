"""Error and time of every fall of the study with the default integrator."""

import time
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.study.angles import angle_of
from sedfiber.study.costs.fall_problem import FallProblem, Integrated
from sedfiber.study.costs.machine import machine_columns
from sedfiber.study.costs.timing import timed_run

TOLERANCES = (1e-7, 1e-8)  # rtol, and atol in a; the second is the study's
TIGHTER = 1e-2  # of the tolerance: the run that the error is measured against


def measure_trajectories(
    runs: Iterable[tuple[float, int]],
    tolerances: Iterable[float] = TOLERANCES,
    n_beads: int = Scene.n_beads,
) -> list[dict[str, Any]]:
    """A row for each (ℬ, k) of ``runs`` and each tolerance: error, time, and what was counted.

    The fall ends with the first sample after the settling time.  ``seconds_*`` are those of the
    integration, ``rhs_units`` the least of them in right-hand sides of the same scene, timed turn
    about; ``simulate_seconds`` are those of one complete ``simulate``: with the terminal shape, the
    approach to it beyond the settling time, checks and audit, at the default tolerance.  ``error`` is
    the largest root-mean-square bead distance over L from a run at a hundredth of the tolerance.
    """
    runs, tolerances = list(runs), list(tolerances)
    for B, k in runs[:1]:
        simulate(Scene(B, angle_of(k), n_beads))  # warms up
    ends = machine_columns()
    return [row | ends for B, k in runs for row in _rows(B, k, tolerances, n_beads)]


def _rows(B: float, angle_index: int, tolerances: list[float], n_beads: int) -> Iterator[dict[str, Any]]:
    scene = Scene(B, angle_of(angle_index), n_beads)
    begun = time.perf_counter()
    complete = simulate(scene)
    seconds = time.perf_counter() - begun
    fall = FallProblem(scene, len(complete.t))
    facts = {
        "B": scene.B,
        "angle_index": angle_index,
        "theta0": scene.theta0,
        "settling_time": complete.settling_time,
        "samples": fall.samples,
    }
    for tolerance in tolerances:
        yield facts | _measured(fall, tolerance) | {"simulate_seconds": seconds}


def _measured(fall: FallProblem, tolerance: float) -> dict[str, Any]:
    numerics = Numerics(rtol=tolerance, atol=tolerance)
    tighter = replace(numerics, rtol=TIGHTER * tolerance, atol=TIGHTER * tolerance)
    timing = timed_run(lambda: fall.by_numerics(numerics), fall.rhs)
    run: Integrated = timing.returned
    return {
        "tolerance": tolerance,
        "error": largest_distance(run.positions, fall.by_numerics(tighter).positions, fall.scene.length),
        **timing.columns,
        **run.columns,
        "rhs_units": timing.units,
    }
