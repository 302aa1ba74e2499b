"""Errors of forecasts as tables: per trajectory, averaged over angles, and against the baseline."""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from sedfiber.core.array_types import Array
from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.measures import ForecastError, ensemble_mean, forecast_error
from sedfiber.simulation.trajectory import Trajectory

RECIPES = ("rollout", "source", "lookup")  # how a forecaster came to be
TIME_FRACTIONS = np.linspace(0.0, 1.0, 201)  # of the settling period of each trajectory


@dataclass(frozen=True)
class ModelLabel:
    """The label of a set of forecasts in the tables: name, training recipe, latent dimension."""

    model: str
    recipe: str
    latent_dim: int | None


@dataclass(frozen=True)
class Measured:
    """E(t) of one forecast trajectory."""

    truth: Trajectory
    error: ForecastError


def measure(truth: Dataset, forecast: Dataset) -> list[Measured]:
    """Pair by (ℬ, angle_index); raises InputError when the two do not hold the same trajectories."""
    found = {(one.B, one.angle_index): one for one in forecast}
    if set(found) != {(one.B, one.angle_index) for one in truth}:
        raise InputError("forecasts and true trajectories are not of the same (B, angle_index)")
    return [Measured(one, forecast_error(one.positions, found[one.B, one.angle_index].positions)) for one in truth]


def trajectory_rows(who: ModelLabel, measured: list[Measured]) -> pd.DataFrame:
    """One row per trajectory: largest, mean and last E, and the largest of its two parts."""
    return pd.DataFrame([_trajectory_row(who, one) for one in measured])


def _trajectory_row(who: ModelLabel, one: Measured) -> dict:
    total = one.error.total
    return {
        "latent_dim": who.latent_dim,
        "test_set": one.truth.split,
        "B": one.truth.B,
        "angle_index": one.truth.angle_index,
        "E_max": total.max(),
        "E_mean": total.mean(),
        "E_final": total[-1],
        "E_shape_max": one.error.shape.max(),
        "E_pos_max": one.error.position.max(),
    }


def ensemble_rows(who: ModelLabel, measured: list[Measured]) -> pd.DataFrame:
    """E, E_shape and E_pos over t/T, averaged over the angles of each ℬ and over all ("all")."""
    groups = _by_B(measured) | {"all": measured}
    return pd.concat([_ensemble(who, B, group) for B, group in groups.items()], ignore_index=True)


def _ensemble(who: ModelLabel, B: float | str, group: list[Measured]) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "model": who.model,
            "recipe": who.recipe,
            "latent_dim": who.latent_dim,
            "test_set": group[0].truth.split,
            "B": B,
            "time_fraction": TIME_FRACTIONS,
            "E": _mean_over_fraction([one.error.total for one in group]),
            "E_shape": _mean_over_fraction([one.error.shape for one in group]),
            "E_pos": _mean_over_fraction([one.error.position for one in group]),
        }
    )


def _mean_over_fraction(errors: list[Array]) -> Array:
    """Mean over trajectories of different lengths at equal fractions of each; the first sample is τ."""
    stretched = [np.interp(TIME_FRACTIONS, np.arange(1, len(e) + 1) / len(e), e) for e in errors]
    return np.mean(stretched, axis=0)


def summary_rows(who: ModelLabel, measured: list[Measured]) -> pd.DataFrame:
    """Per ℬ: worst and median over angles of max_t E, and the largest ensemble mean at any time t."""
    return pd.DataFrame([_summary_row(who, B, group) for B, group in _by_B(measured).items()])


def _summary_row(who: ModelLabel, B: float, group: list[Measured]) -> dict:
    worst = [one.error.total.max() for one in group]
    return {
        "test_set": group[0].truth.split,
        "B": B,
        "model": who.model,
        "recipe": who.recipe,
        "latent_dim": who.latent_dim,
        "E_worst": np.max(worst),
        "E_median": np.median(worst),
        "E_ensemble_max": ensemble_mean([one.error.total for one in group]).max(),
    }


def _by_B(measured: list[Measured]) -> dict[float, list[Measured]]:
    groups: dict[float, list[Measured]] = {}
    for one in measured:
        groups.setdefault(one.truth.B, []).append(one)
    return groups
