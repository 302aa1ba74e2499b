"""True falls with their forecasts, and the best and the worst of each ℬ: lowest and highest maximum of E(t)."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from sedfiber.core.array_types import Array
from sedfiber.core.errors import InputError
from sedfiber.figures.table_input import in_set, select_columns
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.reduced.measures import forecast_error
from sedfiber.simulation.trajectory import Trajectory

LINES = {"best": "-", "worst": (0, (4, 1.5))}  # as in the paper
_MOST_BEADS = 16


@dataclass(frozen=True)
class Pair:
    """A true fall, its forecast at the same samples, and the largest E between the two."""

    truth: Trajectory
    forecast: Trajectory
    E_max: float

    @property
    def E(self) -> Array:
        """E(t) at every sample after t = 0, (T − 1,)."""
        return forecast_error(self.truth.positions, self.forecast.positions).total


def read_pairs(truth: Sequence[Path], forecasts: Sequence[Path], errors: pd.DataFrame, latent_dim: int) -> list[Pair]:
    """`pair_up` of data sets and forecasts in files."""
    return pair_up(_read_all(truth), _read_all(forecasts), errors, latent_dim)


def pair_up(
    truths: Sequence[Trajectory], forecasts: Sequence[Trajectory], errors: pd.DataFrame, latent_dim: int
) -> list[Pair]:
    """Every true fall with its forecast and E_max from the rows of ``errors`` for that latent dimension.

    ``errors`` has the columns latent_dim, test_set, B, angle_index and E_max.  Raises InputError when
    forecasts or rows are missing, or a forecast has other samples than the truth.
    """
    rows = _rows_of(errors, latent_dim)
    found = {_key(fall): fall for fall in forecasts}
    return [_pair(truth, found, rows) for truth in truths]


def pairs_of(pairs: Sequence[Pair], test_set: str) -> list[Pair]:
    """The pairs of one test set; InputError when there are none."""
    chosen = [pair for pair in pairs if pair.truth.split == test_set]
    if not chosen:
        raise InputError(f"input: there is no true fall of test set {test_set}; give its data set and its forecasts")
    return chosen


def best_and_worst(pairs: Sequence[Pair]) -> dict[float, tuple[Pair, Pair]]:
    """Choose for each ℬ, ascending, the pairs with the lowest and the highest E_max."""
    groups: dict[float, list[Pair]] = {}
    for pair in sorted(pairs, key=lambda pair: (pair.truth.B, pair.E_max)):
        groups.setdefault(pair.truth.B, []).append(pair)
    return {B: (group[0], group[-1]) for B, group in groups.items()}


def thinned(shapes: Array) -> Array:
    """Shapes (T, N, 2) with at most 16 of their beads, first and last among them: a smaller file, the same picture."""
    n_beads = shapes.shape[1]
    return shapes[:, np.linspace(0, n_beads - 1, min(n_beads, _MOST_BEADS)).round().astype(int)]


def _read_all(paths: Sequence[Path]) -> list[Trajectory]:
    return [fall for path in paths for fall in read_falls(path)]


def _rows_of(errors: pd.DataFrame, latent_dim: int) -> pd.DataFrame:
    rows = select_columns(errors, ("test_set",), ("latent_dim", "B", "angle_index", "E_max"))
    chosen = rows[rows["latent_dim"] == latent_dim]
    if chosen.empty:
        there = ", ".join(f"{d:g}" for d in sorted(rows["latent_dim"].dropna().unique()))
        raise InputError(f"latent_dim: {latent_dim} is not in the table; give one of {there}")
    return chosen


def _pair(truth: Trajectory, forecasts: dict[tuple, Trajectory], rows: pd.DataFrame) -> Pair:
    name = f"test set {truth.split}, {truth.name}"
    own = in_set(rows, truth.split)
    own = own[(own["B"] == truth.B) & (own["angle_index"] == truth.angle_index)]
    if own.empty or _key(truth) not in forecasts:
        raise InputError(f"input: {name} is missing in the {'table' if own.empty else 'forecasts'}")
    forecast = forecasts[_key(truth)]
    if truth.positions.shape != forecast.positions.shape:
        raise InputError(f"input: {name}: the forecast has other samples than the true fall; forecast it again")
    return Pair(truth, forecast, float(own["E_max"].iloc[0]))


def _key(fall: Trajectory) -> tuple:
    return fall.split, fall.B, fall.angle_index
