"""Training time, time of a forecast and error of each reduced model."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from sedfiber.reduced.model_files import load_forecast_model
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve
from sedfiber.study.costs.choice import Outcomes
from sedfiber.study.costs.choices import measure_single
from sedfiber.study.costs.contestants import compiled_forecasts, forecasters
from sedfiber.study.costs.machine import machine_columns
from sedfiber.study.costs.queries import Query

TOLERANCE = 1e-6  # of the forecasts: far below the models' errors


@dataclass(frozen=True)
class Trained:
    """A forecast model: its folder, how it was trained, with which seed, and for how long."""

    folder: Path
    recipe: str
    seed: int
    seconds: float


def measure_models(
    models: Sequence[Trained], asked: Sequence[Query], reconstruction: pd.DataFrame, curve: TerminalCurve
) -> pd.DataFrame:
    """One row a model and test set: parameters, training seconds, reconstruction and forecast errors, seconds.

    ``reconstruction`` is the table of `study.reconstruction_table`; a model whose forecasts fail
    has infinite errors.
    """
    facts = machine_columns()
    rows = [row for model in models for row in _rows(model, asked, reconstruction, curve)]
    return pd.DataFrame([row | facts for row in rows])


def _rows(model: Trained, asked: Sequence[Query], reconstruction: pd.DataFrame, curve: TerminalCurve) -> list[dict]:
    trained, found = load_forecast_model(model.folder), Outcomes()
    networks = trained.autoencoder, trained.node
    facts = {
        "variant": trained.autoencoder.variant,
        "latent_dim": trained.autoencoder.latent_dim,
        "seed": model.seed,
        "recipe": model.recipe,
        "parameters": sum(weights.numel() for network in networks for weights in network.parameters()),
        "training_seconds": model.seconds,
    }
    contestants = compiled_forecasts(model.folder.name, forecasters(model.folder, [TOLERANCE], curve))
    measure_single(asked, contestants, found)
    (outcome,) = found.all()
    sets = np.array([query.trajectory.split for query in asked])
    table = pd.DataFrame(outcome.rows).assign(test_set=sets)
    return [facts | _row(test_set, own, facts, reconstruction) for test_set, own in table.groupby("test_set")]


def _row(test_set: str, own: pd.DataFrame, facts: dict, reconstruction: pd.DataFrame) -> dict:
    losses = reconstruction[
        (reconstruction["test_set"] == test_set)
        & (reconstruction["variant"] == facts["variant"])
        & (reconstruction["latent_dim"] == facts["latent_dim"])
    ]
    names = ("seconds_least", "seconds_median", "seconds_spread", "evaluations", "decoded", "rhs_units")
    return {
        "test_set": test_set,
        "reconstruction_loss": float(losses["loss"].iloc[0]) if len(losses) else np.nan,
        "E_worst": own["E"].max(),
        "E_median": own["E"].median(),
        "error_worst": own["error"].max(),
        "error_median": own["error"].median(),
        "failed": int(np.isinf(own["error"]).sum()),
        **{name: own[name].median() for name in names if name in own},
    }
