"""The key numbers of the study: this run beside the paper's claim and our target.

Every row has the columns key, quantity, this_run, source (words of what the paper states), bar (an
upper bound, or nothing) and met (yes, no, or nothing where there is no bar).  E is squared: 1e-4 is
1 % of the length.
"""

from dataclasses import dataclass
from fractions import Fraction

import pandas as pd

from sedfiber.core.errors import InputError
from sedfiber.study.targets import (
    ENSEMBLE_TARGETS,
    PAPER_BOUND,
    PAPER_FALLS,
    PAPER_LATENT_DIM,
    RECONSTRUCTION_TARGET,
    SIMULATION_TARGET,
    WORST_TARGETS,
)

NOT_STATED = "not stated"
_RECIPES = {"rollout": "this study", "source": "the paper's recipe", "lookup": "spline lookup"}


@dataclass(frozen=True)
class StudyTables:
    """The tables that the key numbers are read from, as the workflow writes them."""

    trajectories: pd.DataFrame
    regimes: pd.DataFrame
    reconstruction: pd.DataFrame
    baselines: pd.DataFrame
    lags: pd.DataFrame


def key_numbers(tables: StudyTables, model: str, variant: str, angle_index: int) -> pd.DataFrame:
    """One row a number, for the forecast ``model`` of that ``variant`` and the regimes from ``angle_index``.

    Raises InputError when the tables do not have that model.
    """
    if model not in set(tables.baselines["model"]):
        raise InputError(
            f"model: {model!r} is not allowed; give one of {', '.join(tables.baselines['model'].unique())}"
        )
    rows = [
        *_of_simulations(tables.trajectories),
        *_of_regimes(tables.regimes, angle_index),
        *_of_reconstruction(tables.reconstruction, variant, _latent_dim(tables.baselines, model)),
        *_of_dimensions(tables.baselines, model),
        *_of_forecasts(tables.baselines),
        *_of_lags(tables.lags, model),
    ]
    return pd.DataFrame(rows)


def _row(key: str, quantity: str, this_run: float, source: str = NOT_STATED, bar: float | None = None) -> dict:
    met = "" if bar is None else "yes" if this_run <= bar else "no"
    return {"key": key, "quantity": quantity, "this_run": float(this_run), "source": source, "bar": bar, "met": met}


def _of_simulations(runs: pd.DataFrame) -> list[dict]:
    settled = (runs["settled_to"] == "U").sum()
    rows = [
        _row("falls", "simulated falls", len(runs), str(PAPER_FALLS)),
        _row("falls_onto_U", "of these, settled onto the U of their ℬ", settled, "all"),
        _row("longest_fall", "longest settling time, a/U_s", runs["settling_time"].max()),
    ]
    if "error_estimate" in runs:
        worst = runs["error_estimate"].max()
        rows.append(_row("simulation_error", "largest error of a simulation, over L", worst, bar=SIMULATION_TARGET))
    return rows


def _of_regimes(regimes: pd.DataFrame, angle_index: int) -> list[dict]:
    """Where rotation ends and where snaking begins, among the training ℬ."""
    chosen = regimes[(regimes["split"] == "train") & (regimes["angle_index"] == angle_index)]
    where = f"from θ₀ = {Fraction(angle_index, 48)} π"
    rows = []
    for regime, words, pick in (("rotation", "largest", "max"), ("snaking", "least", "min")):
        found = chosen.loc[chosen["regime"] == regime, "B"]
        if len(found):
            quantity = f"{words} training ℬ with {regime}, {where}"
            rows.append(_row(f"{regime}_B", quantity, found.agg(pick), "low ℬ" if regime == "rotation" else "high ℬ"))
    return rows


def _of_reconstruction(table: pd.DataFrame, variant: str, latent_dim: int) -> list[dict]:
    chosen = table[table["latent_dim"] == latent_dim]
    rows = []
    for test_set, part in chosen.groupby("test_set"):
        loss = part.loc[part["variant"] == variant, "loss"].mean()
        pod = part.loc[part["method"] == "pod", "loss"].mean()
        words = f"reconstruction loss at d = {latent_dim}, set {test_set}: {variant} ℬ, mean over seeds"
        rows.append(_row(f"reconstruction_{test_set}", words, loss, "figure only", RECONSTRUCTION_TARGET))
        rows.append(_row(f"reconstruction_pod_{test_set}", f"the same by POD with {latent_dim} modes", pod))
    return rows


def _of_dimensions(table: pd.DataFrame, model: str) -> list[dict]:
    """The least latent dimension whose forecasts meet the target on both sets."""
    ours = table[table["recipe"] == "rollout"]
    largest = ours.groupby(["latent_dim", "test_set"])["E_ensemble_max"].max().unstack()
    met = [d for d, of_sets in largest.iterrows() if all(of_sets[s] <= bar for s, bar in ENSEMBLE_TARGETS.items())]
    rows = [
        _row("latent_dim", "latent dimension of the forecast model", _latent_dim(table, model), str(PAPER_LATENT_DIM))
    ]
    if met:
        words = "least latent dimension whose ensemble means meet the targets"
        rows.append(_row("least_latent_dim", words, min(met), f"{PAPER_LATENT_DIM}, maybe not the least"))
    return rows


def _of_forecasts(table: pd.DataFrame) -> list[dict]:
    """The largest ensemble mean and the worst trajectory of every forecaster and set, at any ℬ and any time."""
    rows = []
    for (model, recipe), part in table.groupby(["model", "recipe"], sort=False):
        for test_set, of_set in part.groupby("test_set"):
            who = f"set {test_set}: {_name(recipe, of_set['latent_dim'].iloc[0])}"
            mean, worst = of_set["E_ensemble_max"].max(), of_set["E_worst"].max()
            targets = _targets(recipe, of_set["latent_dim"].iloc[0], test_set)
            claim = f"below {PAPER_BOUND}" if of_set["latent_dim"].iloc[0] == PAPER_LATENT_DIM else NOT_STATED
            rows.append(
                _row(f"ensemble_{model}_{test_set}", f"largest ensemble mean of E, {who}", mean, claim, targets[0])
            )
            rows.append(_row(f"worst_{model}_{test_set}", f"largest E of any trajectory, {who}", worst, bar=targets[1]))
    return rows


def _targets(recipe: str, latent_dim: float, test_set: str) -> tuple[float | None, float | None]:
    """Targets of the ensemble mean and of the worst trajectory, for this study's own recipe alone."""
    if recipe != "rollout":
        return None, None
    return ENSEMBLE_TARGETS[test_set], WORST_TARGETS[test_set] if latent_dim == PAPER_LATENT_DIM else None


def _of_lags(lags: pd.DataFrame, model: str) -> list[dict]:
    """Half of the forecasts are less late, or early, than this; those whose true shape rests then have no lag."""
    shown = lags[(lags["model"] == model) | (lags["recipe"] == "source")]
    rows = []
    for (name, recipe, test_set), part in shown.groupby(["model", "recipe", "test_set"], sort=False):
        who = f"set {test_set}: {_name(recipe, part['latent_dim'].iloc[0])}"
        quantity = f"median lag at the largest error of shape, a/U_s, {who}"
        rows.append(_row(f"lag_{name}_{test_set}", quantity, part["lag"].abs().median(), "slight"))
    return rows


def _latent_dim(table: pd.DataFrame, model: str) -> int:
    return int(table.loc[table["model"] == model, "latent_dim"].iloc[0])


def _name(recipe: str, latent_dim: float) -> str:
    return _RECIPES[recipe] if pd.isna(latent_dim) else f"{_RECIPES[recipe]}, d = {latent_dim:g}"
