"""E(t) of one trajectory against another, at the times that both cover.

Where the two are sampled at other times, the second is resampled at those of the first by a cubic
spline through each of its coordinates.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from sedfiber.core.array_types import Array, History, Times
from sedfiber.core.errors import InputError
from sedfiber.reduced.measures import ForecastError, forecast_error
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.lag import measure_lag

_SAME = 1e-9  # of the sample's time: what differs by less is a rounding


@dataclass(frozen=True)
class Comparison:
    """``error`` at ``t`` (T − 1,), the common samples after the first.

    ``lag`` is by how much the second is late where E_shape is largest, NaN where the first hardly moves
    there; ``resampled`` whether the second was.
    """

    t: Times
    error: ForecastError
    lag: float
    resampled: bool


def compare(truth: Trajectory, other: Trajectory) -> Comparison:
    """E(t) of ``other`` against ``truth``; raises InputError for two that cannot be compared."""
    _require_alike(truth, other)
    t = truth.t[(truth.t >= other.t[0] * (1 - _SAME)) & (truth.t <= other.t[-1] * (1 + _SAME))]
    if len(t) < 3:
        what = f"{truth.t[0]:g} to {truth.t[-1]:g} and {other.t[0]:g} to {other.t[-1]:g}"
        raise InputError(f"t: the trajectories share {len(t)} samples ({what}); give two that share 3 or more")
    positions = truth.positions[np.isin(truth.t, t)]
    alike = len(other.t) >= len(t) and np.allclose(other.t[: len(t)], t, rtol=_SAME, atol=0.0)
    guess = other.positions[: len(t)] if alike else _resampled(other, t)
    error = forecast_error(positions, guess)
    lag = measure_lag(t, positions, guess)
    return Comparison(t[1:], error, float(lag.lag[lag.worst]), not alike)


def summary(one: Comparison) -> dict[str, dict[str, float]]:
    """The largest of E, E_shape and E_pos and its time, the mean over the samples, and the last."""
    parts = {"E": one.error.total, "E_shape": one.error.shape, "E_pos": one.error.position}
    return {name: _summary(one.t, values) for name, values in parts.items()}


def _summary(t: Times, values: Array) -> dict[str, float]:
    worst = int(values.argmax())
    return {"largest": values[worst], "at t": t[worst], "mean": values.mean(), "last": values[-1]}


def _resampled(run: Trajectory, t: Times) -> History:
    if len(run.t) < 2:
        raise InputError("t: a trajectory of one sample cannot be resampled; give one of 2 or more")
    return CubicSpline(run.t, run.positions)(t)


def _require_alike(truth: Trajectory, other: Trajectory) -> None:
    counts = [(run.fibers.shape[1], run.n_beads) for run in (truth, other)]
    if counts[0] != counts[1]:
        words = " and ".join(f"{fibers} of {beads} beads" for fibers, beads in counts)
        raise InputError(f"n_beads: the trajectories hold {words}; give two with as many")
    if counts[0][0] > 1:
        raise InputError(f"fibers: {counts[0][0]} are not allowed; give trajectories of one fiber")
