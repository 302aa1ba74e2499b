"""Simulation against forecast, with the number of beads.

A forecast works with d numbers however many beads there are; only the writing of positions grows.
For each N a small model is trained on a few falls, enough to time it, and asked a ℬ between.
"""

from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from tempfile import TemporaryDirectory

from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.model_files import save_forecast_model
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder
from sedfiber.reduced.training.train_node import train_node
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve
from sedfiber.study.angles import angle_of
from sedfiber.study.costs.choice import Outcome, Outcomes
from sedfiber.study.costs.choice_tables import COUNTS, SECONDS
from sedfiber.study.costs.choices import measure_single, measure_sweeps
from sedfiber.study.costs.contestants import compiled_forecasts, forecasters, simulations
from sedfiber.study.costs.machine import machine_columns
from sedfiber.study.costs.queries import stored_queries
from sedfiber.study.hard_cases.training_cases import simulated

VARIANT = "decoder"
SIMULATION_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5)
FORECAST_TOLERANCES = (1e-4, 1e-6)
BATCH = 100


@dataclass(frozen=True)
class SmallStudy:
    """The falls to train on, at every pair of ``B`` and ``angle_indices``; asked is the ℬ between, at one index."""

    B: tuple[float, float]
    angle_indices: tuple[int, ...]
    asked_index: int
    latent_dim: int
    autoencoder: AutoencoderSettings
    node: NodeSettings


def measure_model_growth(n_beads: int, study: SmallStudy) -> list[dict]:
    """One row a choice: simulation at each tolerance, forecasts alone and ``BATCH`` at once."""
    training = simulated(n_beads, study.B, study.angle_indices)
    asked = stored_queries(simulated(n_beads, (sqrt(study.B[0] * study.B[1]),), (study.asked_index,)))
    found, machine = Outcomes(), machine_columns()
    with TemporaryDirectory() as folder:
        _train(training, study, Path(folder))
        at = forecasters(Path(folder), FORECAST_TOLERANCES, TerminalCurve.between(*study.B, n_beads))
    measure_single(asked, [*simulations(SIMULATION_TOLERANCES, n_beads), *compiled_forecasts(VARIANT, at)], found)
    measure_sweeps(asked, VARIANT, at, [BATCH], found)
    facts = {"n_beads": n_beads, "B": asked[0].B, "theta0": angle_of(study.asked_index)}
    return [facts | _row(outcome) | machine for outcome in found.all()]


def _train(training: Dataset, study: SmallStudy, folder: Path) -> None:
    autoencoder = train_autoencoder(training, VARIANT, study.latent_dim, 0, study.autoencoder)
    node = train_node(training, autoencoder, 0, study.node)
    save_forecast_model(ForecastModel(autoencoder, node, study.node.rtol, study.node.atol), folder, {})


def _row(outcome: Outcome) -> dict:
    """The one query's numbers."""
    (numbers,) = outcome.rows
    return outcome.facts | {name: numbers.get(name) for name in ("error", "E", *SECONDS, *COUNTS)}
