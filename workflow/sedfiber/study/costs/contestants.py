"""The ways to an answer that are compared, each as a call that takes one query to bead positions.

Each gives every sample to the end of the fall, from ℬ and θ₀; what does not depend on
them is made before: the compiled system of a simulation, a model's weights, the lookup's table.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path

import numpy as np

from sedfiber.core.array_types import History
from sedfiber.physics.integrators import LSODA, Tolerances
from sedfiber.reduced.compiled.model import load_compiled
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.forecaster import Forecaster
from sedfiber.reduced.model_files import load_forecast_model
from sedfiber.reduced.pod import pod_basis
from sedfiber.reduced.scaling import Scales, residual_history
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve
from sedfiber.study.costs.choice import FORECAST, GALERKIN, LOOKUP, SIMULATION, TORCH, Choice
from sedfiber.study.costs.galerkin import PodGalerkin
from sedfiber.study.costs.queries import Query
from sedfiber.study.lookup import LookupTable

GALERKIN_TOLERANCE = 1e-5  # the error of the modes is larger
Counts = dict[str, int]
Answer = tuple[History, Counts]


@dataclass(frozen=True)
class Contestant:
    """``ask(query)`` makes the call to time, which returns positions (T, N, 2 or 3) and what was counted."""

    choice: Choice
    ask: Callable[[Query], Callable[[], Answer]]


def simulations(tolerances: Sequence[float], n_beads: int) -> list[Contestant]:
    """The default integrator at each tolerance."""
    return [_simulation(tolerance, n_beads) for tolerance in tolerances]


def galerkins(training: Dataset, modes: Sequence[int]) -> list[Contestant]:
    """POD–Galerkin with so many modes of the training shapes."""
    scales = Scales.of(training)
    residuals = np.concatenate([residual_history(one, scales) for one in training])
    return [_galerkin(residuals, r) for r in modes]


def lookups(training: Dataset) -> list[Contestant]:
    """Splines through the training trajectories."""
    table = LookupTable(training)

    def ask(query: Query) -> Callable[[], Answer]:
        one = query.trajectory
        return lambda: (table.forecast(one.B, one.theta0, one.t), {})

    return [Contestant(Choice(LOOKUP, "splines", 0), ask)]


def forecasters(folder: Path, tolerances: Sequence[float], curve: TerminalCurve) -> dict[float, Forecaster]:
    """A model in compiled code, at each tolerance."""
    return {tolerance: Forecaster(load_compiled(folder, tolerance, tolerance), curve) for tolerance in tolerances}


def compiled_forecasts(name: str, at: Mapping[float, Forecaster]) -> list[Contestant]:
    """Single forecasts at each tolerance; ``out`` is there before, as in a program that asks many times."""
    return [_compiled(name, tolerance, forecaster) for tolerance, forecaster in at.items()]


def torch_forecast(name: str, folder: Path, forecaster: Forecaster) -> Contestant:
    """The same model through torchdiffeq, at its own tolerance; ``forecaster`` makes the starts."""
    model = load_forecast_model(folder)

    def ask(query: Query) -> Callable[[], Answer]:
        one = query.trajectory
        return lambda: (model.forecast_many([forecaster.start(one.B, one.theta0)], one.t)[0], {})

    return Contestant(Choice(FORECAST, f"{name}{TORCH}", forecaster.model.latent_dim, model.rtol), ask)


def _simulation(tolerance: float, n_beads: int) -> Contestant:
    numerics = Numerics(rtol=tolerance, atol=tolerance)

    def run(query: Query) -> Answer:
        integrated = query.fall.by_numerics(numerics)
        return integrated.positions, integrated.columns

    return Contestant(Choice(SIMULATION, "LSODA", 2 * n_beads, tolerance), lambda query: partial(run, query))


def _galerkin(residuals: np.ndarray, r: int) -> Contestant:
    basis = pod_basis(residuals, r)

    def run(query: Query) -> Answer:
        fall = query.fall
        projected = PodGalerkin(assemble(fall.scene), basis, query.trajectory.terminal)
        integrator = LSODA(projected, Tolerances(GALERKIN_TOLERANCE, GALERKIN_TOLERANCE))
        start = projected.to_state(fall.start_positions[:, :2])
        states = np.array(list(islice(integrator.states(start, fall.interval), fall.samples)))
        return projected.to_positions(states), {"rhs": projected.rhs_count, "jacobians": projected.jacobian_count}

    return Contestant(Choice(GALERKIN, f"{r} modes", r, GALERKIN_TOLERANCE), lambda query: partial(run, query))


def _compiled(name: str, tolerance: float, forecaster: Forecaster) -> Contestant:
    model = forecaster.model

    def ask(query: Query) -> Callable[[], Answer]:
        one = query.trajectory
        out = np.empty((len(one.t), model.scales.n_beads, 2))

        def run() -> Answer:
            model.forecast_plane(forecaster.start(one.B, one.theta0), one.t, out)
            return out, {"evaluations": model.evaluations, "decoded": model.decoded}

        return run

    return Contestant(Choice(FORECAST, name, model.latent_dim, tolerance), ask)
