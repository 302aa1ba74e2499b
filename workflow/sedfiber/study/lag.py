"""The lag of a forecast shape, and the error left without it.

The lag δ(t) is that of the true shape which comes closest to the forecast shape of now:

    δ(t) = argmin_δ  Σ_beads |X̄_true(t − δ) − X̄_forecast(t)|²,   the minimum next to δ = 0

A late forecast has δ > 0.  A lag is defined only while the true shape moves: where its rate
|dX̄_true/dt| is at least `MOVING` of the greatest along the trajectory.
"""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from sedfiber.core.array_types import Array, History, Times
from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.error_tables import ModelLabel

MOVING = 0.1  # of the greatest rate: below, a small error of shape would pass for a long lag
_ROUNDS = 60  # of Gauss and Newton's method; a good start needs about five
_SETTLED = 1e-12  # of the trajectory's duration: a smaller step ends the search


@dataclass(frozen=True)
class Lag:
    """Lags of all samples after t = 0, (T − 1,): δ, NaN where not defined; E_shape as it is and without the lag."""

    t: Times
    lag: Array
    E_shape: Array
    E_shape_unlagged: Array

    @property
    def worst(self) -> int:
        """The sample of the largest E_shape."""
        return int(self.E_shape.argmax())

    @property
    def largest(self) -> float:
        """The largest |δ|, NaN when none is defined."""
        defined = self.lag[np.isfinite(self.lag)]
        return float(np.abs(defined).max()) if defined.size else np.nan


def measure_lag(t: Times, truth: History, forecast: History) -> Lag:
    """δ(t) of ``forecast`` behind ``truth``, both (T, N, 3), lengths in ``a``.

    Raises InputError when the two differ in shape.
    """
    if truth.shape != forecast.shape:
        raise InputError(f"forecast has shape {forecast.shape}, the trajectory {truth.shape}")
    n_beads = truth.shape[1]
    unit = n_beads * (2.0 * n_beads) ** 2  # a², of E_shape
    path = CubicSpline(t, _flat_shapes(truth))
    t, guess, moving = t[1:], _flat_shapes(forecast)[1:], _is_moving(path)[1:]
    moments = t.copy()
    moments[moving] = _closest_moments(path, t[moving], guess[moving])
    lag = np.where(moving, t - moments, np.nan)
    return Lag(t, lag, _distance(path, t, guess) / unit, _distance(path, moments, guess) / unit)


def lag_rows(who: ModelLabel, truth: Dataset, forecast: Dataset) -> pd.DataFrame:
    """One row per trajectory: lag and error at the moment of the largest E_shape, and the largest |lag|.

    Raises InputError when the two do not hold the same trajectories.
    """
    if [(one.B, one.angle_index) for one in truth] != [(one.B, one.angle_index) for one in forecast]:
        raise InputError("forecasts and true trajectories are not of the same (B, angle_index)")
    return pd.DataFrame([_row(who, *pair) for pair in zip(truth, forecast, strict=True)])


def _row(who: ModelLabel, truth: Trajectory, forecast: Trajectory) -> dict:
    measured = measure_lag(truth.t, truth.positions, forecast.positions)
    worst = measured.worst
    before, after = measured.E_shape[worst], measured.E_shape_unlagged[worst]
    return {
        "model": who.model,
        "recipe": who.recipe,
        "latent_dim": who.latent_dim,
        "test_set": truth.split,
        "B": truth.B,
        "angle_index": truth.angle_index,
        "t_worst": measured.t[worst],
        "lag": measured.lag[worst],
        "lag_max": measured.largest,
        "E_shape_max": before,
        "E_shape_unlagged": after,
        "explained": 1.0 - after / before if before > 0.0 else 0.0,
    }


def _flat_shapes(positions: History) -> Array:
    """X̄ of every sample, (T, 3N)."""
    shapes = positions - positions[:, [positions.shape[1] // 2]]
    return shapes.reshape(len(positions), -1)


def _is_moving(path: CubicSpline) -> NDArray[np.bool_]:
    """Whether a lag is defined, at every sample (T,)."""
    rate = np.linalg.norm(path(path.x, 1), axis=1)
    return rate > MOVING * rate.max()


def _distance(path: CubicSpline, moments: Array, guess: Array) -> Array:
    """Σ_beads |X̄_true(moment) − X̄_forecast|², (T,)."""
    return ((path(moments) - guess) ** 2).sum(axis=1)


def _closest_moments(path: CubicSpline, t: Times, guess: Array) -> Array:
    """The moments at which the true path comes closest to each guess, found downhill from ``t``.

    The residual projected on the true rate gives each step; one that would not get closer is halved.
    """
    first, last = path.x[[0, -1]]
    moments, distance = t.copy(), _distance(path, t, guess)
    step = _steps(path, moments, guess)
    for _ in range(_ROUNDS):
        if not (np.abs(step) > _SETTLED * (last - first)).any():
            break
        tried = np.clip(moments + step, first, last)
        closer = _distance(path, tried, guess)
        better = closer < distance
        moments, distance = np.where(better, tried, moments), np.where(better, closer, distance)
        step = np.where(better, _steps(path, moments, guess), 0.5 * step)
    return moments


def _steps(path: CubicSpline, moments: Array, guess: Array) -> Array:
    """Gauss and Newton's step of each moment: ⟨X̄', X̄_forecast − X̄_true⟩ / ⟨X̄', X̄'⟩."""
    rate = path(moments, 1)
    return ((guess - path(moments)) * rate).sum(axis=1) / np.maximum((rate**2).sum(axis=1), np.finfo(float).tiny)
