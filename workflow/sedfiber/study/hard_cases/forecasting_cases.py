"""Forecasts by a trained model where such models go wrong: long times, values and shapes they have not seen."""

import itertools
import math
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from sedfiber.core.array_types import Array, History, Positions, Times
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.forecaster import Forecaster, load_model
from sedfiber.reduced.model_files import load_forecast_model
from sedfiber.reduced.strictness import warning_line
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.equilibria.steady import steady_state
from sedfiber.simulation.settling import SETTLED, distance_to_terminal
from sedfiber.study.hard_cases.case import Measurement, must_refuse, yes_or_no

TIMES = 10.0  # settling times
SAMPLES = 400
ROUNDED = 1e-4  # L: what rounding may do to a forecast in float32
ACCURATE = 1e-2  # L: the target of the forecasts themselves, E = 1e-4
BELOW, ABOVE = (0.1, 0.5), (2.0, 4.0)  # ℬ over the ends of the training range
STEEP = (math.pi / 2, 1.7, 3.0, -math.pi)  # θ₀: upright, and turned by more than that
REACH = "largest distance of a bead from the centre bead, L"
END = "largest distance from the terminal shape at the end, L"


def forecast_ten_settling_times(model: Path) -> Iterable[Measurement]:
    """ℬ and θ₀ over the whole training range, and on for ten settling times."""
    forecaster = load_model(model)
    yield from _journeys(forecaster, [(B, theta0, None) for B, theta0 in _grid(forecaster)], 0.55)


def forecast_outside_range(model: Path) -> Iterable[Measurement]:
    """ℬ below and above the training range as far as there is a U; θ₀ up to π; and what --strict says."""
    forecaster = load_model(model)
    scales = forecaster.model.scales
    middle = math.sqrt(scales.B_min * scales.B_max)
    far = [scales.B_min * factor for factor in BELOW] + [scales.B_max * factor for factor in ABOVE]
    reached = [B for B in far if _has_terminal_shape(B, scales.n_beads)]
    asked = list(itertools.product(reached, (0.3, scales.theta0_max), [None]))
    upright = [(middle, theta0, None) for theta0 in STEEP]
    note = (
        f"B = {', '.join(f'{B:g}' for B in reached)}; at B = {middle:g} theta0 = {', '.join(f'{a:.4g}' for a in STEEP)}"
    )
    yield from _journeys(forecaster, asked + upright, 1.0, note)
    silent = [one for one in [*asked, upright[0]] if not forecaster.warnings(*one)]
    yield Measurement("forecasts outside the range without a warning", len(silent), 0)
    t = np.linspace(0.0, 50.0, 11)
    turned, same = forecaster.forecast(middle, 3.0, t), forecaster.forecast(middle, 3.0 - math.pi, t)
    away = largest_distance(turned, same[:, ::-1], 2.0 * scales.n_beads)
    yield Measurement("a fiber turned by π, its beads counted from the other end: distance, L", away, 1e-9)
    yield yes_or_no("--strict: refused in one line", *_strict_refuses(forecaster, reached[0]))


def forecast_far_shape(model: Path) -> Iterable[Measurement]:
    """An arch, an S and a zigzag as starts, at three ℬ, and starts that are none."""
    forecaster = load_model(model)
    shapes = _far_shapes(forecaster.model.scales.n_beads)
    asked = [(B, 0.3, shape) for B in _B_values(forecaster) for shape in shapes.values()]
    yield from _journeys(forecaster, asked, 1.0)
    silent = [one for one in asked if not forecaster.warnings(*one)]
    yield Measurement("far shapes without a warning", len(silent), 0)
    flat = shapes["S"]
    out_of_plane = np.hstack([flat, 0.1 * flat[:, :1]])
    for name, shape in {"out of the plane": out_of_plane, "NaN": flat * np.nan, "no beads": flat[:0]}.items():
        start = partial(forecaster.settle, forecaster.model.scales.B_min, 0.3, shape=shape.tolist())
        yield must_refuse(f"{name}: refused in one line", start, "shape")


def forecast_single_and_batched(model: Path) -> Iterable[Measurement]:
    """Starts of all kinds alone, in one sweep, and by torchdiffeq, which the model was judged with."""
    forecaster, judged = load_model(model), load_forecast_model(model)
    B_values, shapes = _B_values(forecaster), _far_shapes(forecaster.model.scales.n_beads)
    asked: list[tuple[float, float, Array | None]] = [(B, theta0, None) for B, theta0 in _grid(forecaster)]
    asked += [(BELOW[0] * B_values[0], math.pi / 2, None), *((B_values[-1], 0.3, shape) for shape in shapes.values())]
    starts, t = [forecaster.start(*one) for one in asked], _long_times(forecaster)
    alone, length = forecaster.model.forecast_many(starts, t), 2.0 * forecaster.model.scales.n_beads
    swept, _ = forecaster.model.sweep(starts, t[1], [len(t)] * len(starts))
    together = np.pad(swept.reshape(*alone.shape[:-1], 2), ((0, 0), (0, 0), (0, 0), (0, 1)))
    what = f"{len(starts)} starts: distance between alone and"
    yield Measurement(f"{what} in a sweep, L", _farthest(alone, together, length), 1e-6)
    torchdiffeq = np.concatenate([judged.forecast_many([start], t) for start in starts])
    yield Measurement(f"{what} by torchdiffeq, L", _farthest(alone, torchdiffeq, length), 1e-6)
    batched = judged.forecast_many(starts, t)
    yield Measurement(f"{what} by torchdiffeq in one batch, L", _farthest(alone, batched, length), 1e-6)


def forecast_float32(model: Path) -> Iterable[Measurement]:
    """The same networks in both precisions, over the whole training range."""
    forecaster = load_model(model)
    grid, t = list(_grid(forecaster)), _long_times(forecaster)
    fine, coarse = (_swept(forecaster, grid, t, dtype) for dtype in (np.float64, np.float32))
    length = 2.0 * forecaster.model.scales.n_beads
    apart = [largest_distance(one, other, length) for one, other in zip(coarse, fine, strict=True)]
    tilted = [value for value, (_, theta0) in zip(apart, grid, strict=True) if theta0 == 0.0]
    steep = [value for value, (_, theta0) in zip(apart, grid, strict=True) if theta0 != 0.0]
    yield Measurement("distance between float32 and float64, L", max(steep), ROUNDED)
    note = "at high B the fiber leaves the unstable W, which multiplies rounding; the bound is E = 1e-4"
    yield Measurement("the same from theta0 = 0, L", max(tilted), ACCURATE, note)
    ends = [_distance(forecaster, B, x[-1:])[-1] for (B, _), x in zip(grid, coarse, strict=True)]
    yield Measurement(f"float32: {END}", max(ends), SETTLED)


def _swept(forecaster: Forecaster, grid: list[tuple[float, float]], t: Times, dtype: type) -> History:
    """Positions (S, T, N, 3) of a sweep in one precision."""
    B, theta0 = zip(*grid, strict=True)
    rows, _ = forecaster.sweep(B, theta0, t[1], [len(t)] * len(grid), dtype=dtype)
    return np.pad(rows.astype(float).reshape(len(grid), len(t), -1, 2), ((0, 0), (0, 0), (0, 0), (0, 1)))


def _farthest(one: Array, other: Array, length: float) -> float:
    """The largest distance at any sample of any start, over L."""
    return max(largest_distance(*pair, length) for pair in zip(one, other, strict=True))


def _B_values(forecaster: Forecaster) -> list[float]:
    scales = forecaster.model.scales
    return [scales.B_min, math.sqrt(scales.B_min * scales.B_max), scales.B_max]


def _grid(forecaster: Forecaster) -> Iterator[tuple[float, float]]:
    """Both ends and the middle of the training range in ℬ and θ₀; θ₀ = 0 is the tilted start."""
    steepest = forecaster.model.scales.theta0_max
    return itertools.product(_B_values(forecaster), (0.0, -0.5 * steepest, steepest))


def _long_times(forecaster: Forecaster) -> History:
    """Sample times up to twice the settling time of the slowest start of the grid's corners, (T,)."""
    slowest = max(forecaster.settle(B, theta0).t[-1] for B, theta0 in _grid(forecaster))
    return np.linspace(0.0, 2.0 * slowest, SAMPLES)


def _has_terminal_shape(B: float, n_beads: int) -> bool:
    """Whether the steady solver reaches ℬ: the U ends in a fold."""
    try:
        steady_state(B, n_beads)
    except NumericalError:
        return False
    return True


def _journeys(
    forecaster: Forecaster, asked: list[tuple[float, float, Any]], reach: float, note: str = ""
) -> Iterator[Measurement]:
    """Ten settling times of each start: within ``reach``, at the terminal shape, or at least not silent."""
    reaches, ends, silent = [], [], 0
    for B, theta0, shape in asked:
        settled = forecaster.settle(B, theta0, shape=shape)
        last = TIMES * (settled.settling_time or settled.t[-1])
        positions = forecaster.forecast(B, theta0, np.linspace(0.0, max(last, 1.0), SAMPLES), shape)
        offset = positions - positions[:, positions.shape[1] // 2, None]
        reaches.append(np.linalg.norm(offset, axis=-1).max() / (2.0 * positions.shape[1]))
        ends.append(_distance(forecaster, B, positions)[-1])
        silent += int(ends[-1] >= SETTLED and not settled.metadata["model"]["warnings"])
    yield Measurement(REACH, max(reaches), reach, note)
    yield Measurement(END, max(ends), SETTLED)
    yield Measurement("forecasts that end elsewhere and do not say so", silent, 0)


def _distance(forecaster: Forecaster, B: float, positions: History) -> History:
    """Distance (T,) of positions (T, N, 3) to the steady solver's shape, over L."""
    n_beads = positions.shape[1]
    shapes = positions - positions[:, n_beads // 2, None]
    return distance_to_terminal(shapes, steady_state(B, n_beads).positions, 2.0 * n_beads)


def _far_shapes(n_beads: int) -> dict[str, Positions]:
    """Bonds of 2 a whose directions no settling fiber has, each (N, 2)."""
    s = np.linspace(-1.0, 1.0, n_beads - 1)
    turns = {"arch": -1.5 * s, "S": 1.2 * np.sin(np.pi * s), "zigzag": 0.8 * (-1.0) ** np.arange(n_beads - 1)}
    return {name: _chain(angles) for name, angles in turns.items()}


def _chain(angles: Positions) -> Positions:
    bonds = 2.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.vstack([np.zeros(2), np.cumsum(bonds, axis=0)])


def _strict_refuses(forecaster: Forecaster, B: float) -> tuple[bool, str]:
    try:
        warning_line(forecaster.settle(B, 0.3), strict=True)
    except InputError as error:
        return "\n" not in str(error), str(error)
    return False, "accepted"
