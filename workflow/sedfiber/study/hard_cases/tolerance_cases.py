"""Integrators pushed where they do not want to go: loose tolerances, and an explicit method on a stiff fiber."""

from collections.abc import Iterable
from functools import partial

from sedfiber.core.errors import NumericalError
from sedfiber.physics.integrators import INTEGRATORS
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.angles import angle_of
from sedfiber.study.hard_cases.case import Measurement, must_refuse

LOOSE = (1e-2, 1e-3)
RUNS = ((100.0, 22), (1000.0, 12), (10000.0, 0), (10000.0, 22))
ALLOWED = 10.0  # times the tolerance, over L
EXPLICIT_END = 40.0  # a/U_s at ℬ = 100, where the explicit method takes thousands of steps a time unit


def loose_tolerances() -> Iterable[Measurement]:
    """Tolerances of 1e-2 and 1e-3 with every integrator: near the truth, or an error; never wrong with success."""
    truths = {run: _truth(*run) for run in RUNS}
    for name in INTEGRATORS:
        for tolerance in LOOSE:
            off = [_error_in_tolerances(name, tolerance, run, truth) for run, truth in truths.items()]
            accepted = [value for value in off if value is not None]
            note = f"{len(off) - len(accepted)} of {len(off)} runs refused"
            worst = max(accepted, default=0.0)
            yield Measurement(f"{name} at {tolerance:g}: largest error over the tolerance, L", worst, ALLOWED, note)


def _truth(B: float, k: int) -> Trajectory:
    return simulate(Scene(B, angle_of(k)), Numerics("Radau", 1e-12, 1e-12))


def _error_in_tolerances(name: str, tolerance: float, run: tuple[float, int], truth: Trajectory) -> float | None:
    """Largest distance from the truth over L and the tolerance; None where the run ends with an error."""
    scene = Scene(run[0], angle_of(run[1]))
    end = EXPLICIT_END if name == "dopri5" and run[0] <= 100.0 else float(truth.t[-1])
    try:
        loose = simulate(scene, Numerics(name, tolerance, tolerance), end)
    except NumericalError:
        return None
    return largest_distance(loose.positions, truth.positions[: len(loose.t)], scene.length) / tolerance


def explicit_on_a_stiff_fiber() -> Iterable[Measurement]:
    """The paper's explicit method at ℬ = 100, at its own sampling and at a coarser one."""
    scene = Scene(100.0, angle_of(22))
    truth = simulate(scene, Numerics("Radau", 1e-10, 1e-10), 40.0)
    run = simulate(scene, Numerics("dopri5"), truth.t[-1])
    apart = largest_distance(run.positions, truth.positions, scene.length)
    cost = f"{run.metadata['counters']['rhs']} right-hand sides for {truth.t[-1]:g} a/U_s"
    yield Measurement("samples 0.5 a/U_s apart: distance from Radau at 1e-10, L", apart, 1e-4, cost)
    sparse = partial(simulate, scene, Numerics("dopri5", interval=5.0), truth.t[-1])
    words = "samples 5 a/U_s apart: refused, with the reason and the default as advice"
    yield must_refuse(words, sparse, "stiff", "implicit", "default")
