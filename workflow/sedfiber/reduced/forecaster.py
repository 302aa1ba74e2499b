"""A trained model as a user meets it: ℬ, θ₀ and times in, bead positions out; without torch.

Many forecasts are made in compiled code (`load_model`), a few in plain NumPy (`load_plain_model`).

The terminal shape and velocity come from the series that lies beside the model, and from the
steady solver outside the series' range, or where there is none. A fiber is the same with
its beads counted from the other end, so that a start beyond ±π/2 is forecast in reversed order.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from sedfiber.core.array_types import Array, History, Positions, Times
from sedfiber.core.errors import InputError
from sedfiber.core.validation import number_within
from sedfiber.reduced.compiled.tolerances import RTOL
from sedfiber.reduced.compiled.trained import TrainedModel
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.model_folder import SHIPPED
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, read_terminal_curve
from sedfiber.simulation.settling import SETTLED, distance_to_terminal, settling_time
from sedfiber.simulation.trajectory import Trajectory

_FIRST_LOOK = 256  # samples forecast before the first look at whether the fiber has settled
_MOST_SAMPLES = 2**17
_FLAT = 1e-6  # a: how far from its plane a start may be, for a sample of another forecast is flat up to rounding
_REST_TIME, _REST_CHANGE = 1000.0, 1e-6  # a/U_s, L: a distance that changes less in that time stands still

# Root-mean-square bead distance over L between a start and what the model makes of it, above
# which the start counts as far from any seen: 6 times the worst of all training samples of the
# study's model (8.7e-4), twice the worst of its test samples (2.8e-3).
FAR = 5e-3


class Forecaster:
    """A loaded model; ``model.scales`` holds the range it was trained on."""

    def __init__(self, model: TrainedModel, curve: TerminalCurve | None = None, hydrodynamics: str = "RPY"):
        self.model: Any = model  # compiled, or plain without a sweep: imported by `load_model` where it is used
        self.curve = curve
        self.hydrodynamics = hydrodynamics if curve is None else curve.hydrodynamics

    def forecast(self, B: float, theta0: float, t: Times, shape: Any = None) -> History:
        """Positions (T, N, 3) at ascending times ``t`` (T,), the centre bead at the origin at time 0.

        The start is straight, or a ``shape`` as a Scene takes it: planar, turned by ``theta0``.
        `warnings` tells whether such a start is like those of the training. Raises InputError
        for values that are not allowed, NumericalError when the integration fails.
        """
        scene = self._scene(B, theta0, shape)
        return self._positions(scene, self._start(scene), np.asarray(t, dtype=float))

    def settle(
        self, B: float, theta0: float, interval: float = 0.5, t_end: float | None = None, shape: Any = None
    ) -> Trajectory:
        """Samples every ``interval`` until the forecast has settled, or until ``t_end``.

        One that settles elsewhere, or not at all, has ``settling_time`` None and says so in
        ``metadata["model"]["warnings"]``, where `warnings` stand too. Raises as `forecast` does.
        """
        scene = self._scene(B, theta0, shape)
        start = self._start(scene)
        count = _FIRST_LOOK if t_end is None else int(np.floor(t_end / interval * (1 + 1e-12))) + 1
        while True:
            t = interval * np.arange(count)
            positions = self._positions(scene, start, t)
            shapes = positions - positions[:, scene.n_beads // 2, None]
            distance = distance_to_terminal(shapes, start.terminal, scene.length)
            settled = settling_time(t, distance)
            if t_end is not None or settled is not None or _stands_still(t, distance) or count >= _MOST_SAMPLES:
                break
            count *= 2
        keep = len(t) if t_end is not None or settled is None else int(np.searchsorted(t, settled)) + 1
        facts = self._metadata(scene, start) | {"numerics": {"interval": interval, "t_end": t_end}}
        facts["model"]["warnings"] += _doubts_about_the_end(t, distance, settled, t_end)
        return Trajectory(t[:keep], positions[:keep], facts | {"settling_time": settled})

    def sweep(
        self,
        B: Sequence[float] | Array,
        theta0: Sequence[float] | Array,
        interval: float,
        counts: Sequence[int],
        out: Array | None = None,
        dtype: type = np.float64,
    ) -> tuple[Array, Array]:
        """Many straight starts at once: positions in the plane (sum counts, N, 2), and where each begins (S + 1,).

        Start s has ℬ ``B[s]``, inclination ``theta0[s]`` and ``counts[s]`` samples, ``interval`` apart from
        time 0 on. Writing to an ``out`` that was written to before saves the most time: fresh memory takes
        longer than the forecasts. A start beyond ±π/2 has its beads counted from the left. For what `load_model`
        gives: a plain model has no sweep. Raises as `forecast`.
        """
        if not len(B) == len(theta0) == len(counts):
            lengths = f"{len(B)}, {len(theta0)} and {len(counts)} values"
            raise InputError(f"sweep: B, theta0 and counts have {lengths}; give as many of each")
        starts = [self.start(*one) for one in zip(B, theta0, strict=True)]
        return self.model.sweep(starts, interval, counts, out, dtype)

    def warnings(self, B: float, theta0: float, shape: Any = None) -> list[str]:
        """Reasons to distrust a forecast of this start; empty within the training range."""
        scene = self._scene(B, theta0, shape)
        return self._doubts_about_the_start(scene, self._start(scene))

    def start(self, B: float, theta0: float, shape: Any = None) -> Start:
        """The model's start, for `CompiledModel.forecast_many`; the first bead is the left end."""
        return self._start(self._scene(B, theta0, shape))

    def covers(self, B: float, theta0: float) -> bool:
        """Whether a straight start at (ℬ, θ₀), its beads counted from either end, is within the training range."""
        return self.model.scales.covers(B, math.remainder(theta0, math.pi))

    def range_words(self) -> str:
        """The training range in words, for a warning."""
        scales = self.model.scales
        return f"B from {scales.B_min:g} to {scales.B_max:g} and |theta0| up to {scales.theta0_max:.4g}"

    def _scene(self, B: float, theta0: float, shape: Any) -> Scene:
        facts: dict[str, Any] = {"n_beads": self.model.scales.n_beads, "hydrodynamics": self.hydrodynamics}
        if shape is None:
            return Scene(B, theta0, **facts)
        given = Scene(B, theta0, space="volume", shape=shape, **facts)
        if np.abs(given.start()[:, 2]).max() > _FLAT:
            raise InputError("shape: leaves the plane z = 0, in which the model was trained; give z = 0 for every bead")
        rows = given.shape if given.shape in (None, "rest") else np.array(given.shape)[:, :2]
        return Scene(B, theta0, shape=rows, **facts)

    def _start(self, scene: Scene) -> Start:
        initial = np.zeros((scene.n_beads, 3))
        initial[:, : scene.dim] = scene.start()
        terminal, velocity = self._terminal(scene.B)
        nearest_B = self.model.scales.nearest_B(scene.B)
        nearest = None if nearest_B == scene.B else (nearest_B, self._terminal(nearest_B)[0])
        return Start(scene.B, initial[:: _order(initial)], terminal, velocity, nearest)

    def _terminal(self, B: float) -> tuple[Positions, Array]:
        """Terminal shape (N, 3) and velocity (3,)."""
        if self.curve is not None and self.curve.covers(B):
            return self.curve(B)
        return _solved(B, self.model.scales.n_beads, self.hydrodynamics)

    def _positions(self, scene: Scene, start: Start, t: Times) -> History:
        """The forecast with its beads in the scene's order."""
        return self.model.forecast_many([start], t)[0][:, :: _order(scene.start())]

    def _doubts_about_the_start(self, scene: Scene, start: Start) -> list[str]:
        words = []
        straight = scene.shape is None
        if not self.covers(scene.B, scene.start_angle if straight else 0.0):
            values = f"B={scene.B:g}, theta0={scene.theta0:g}" if straight else f"B={scene.B:g}"
            words.append(f"{values} is outside the training range ({self.range_words()})")
        error = self.model.start_error(start)
        if error > FAR:
            words.append(
                f"the start is far from any seen: {error:.2g} L from what the model makes of it (up to {FAR:g})"
            )
        return words

    def _metadata(self, scene: Scene, start: Start) -> dict:
        warnings = self._doubts_about_the_start(scene, start)
        return {
            "kind": "forecast",
            **scene.facts(),
            "model": {
                "variant": self.model.variant,
                "latent_dim": self.model.latent_dim,
                "trained_for": self.range_words(),
                "within_training_range": not warnings,
                "warnings": warnings,
            },
        }


def load_model(folder: str | Path | None = None, tolerance: float = RTOL) -> Forecaster:
    """Load a forecast model, by default the one shipped with the package; raises InputError for anything else.

    ``tolerance`` of a step, relative and in L/2, bounds how far a forecast is from an exact solution of
    the model; 1e-4 takes 0.6 of the default's time and adds an error of 1e-5 L in the median.
    """
    from sedfiber.reduced.compiled.model import load_compiled  # numba: for those who forecast many

    number_within("tolerance", tolerance, 1e-12, 0.1, "a number from 1e-12 to 0.1")
    folder = SHIPPED if folder is None else folder
    return Forecaster(load_compiled(folder, tolerance, tolerance), _curve_beside(folder))


def load_plain_model(folder: str | Path | None = None) -> Forecaster:
    """The same model for a few forecasts, without numba: 15 ms for one, of which `sweep` is not there."""
    from sedfiber.reduced.plain.model import load_plain

    folder = SHIPPED if folder is None else folder
    return Forecaster(load_plain(folder), _curve_beside(folder))


def _curve_beside(folder: str | Path) -> TerminalCurve | None:
    path = Path(folder) / CURVE
    return read_terminal_curve(path) if path.exists() else None


@lru_cache(maxsize=4096)  # a few MB
def _solved(B: float, n_beads: int, hydrodynamics: str) -> tuple[Positions, Array]:
    """Terminal shape and velocity by the steady solver; forecasts ask for them more than once."""
    from sedfiber.simulation.equilibria.steady import (
        steady_state,  # compiled: only for those who leave the curve's range
    )

    steady = steady_state(B, n_beads, hydrodynamics)
    return steady.positions, steady.velocity


def _order(start: Array) -> int:
    """1 for a start (N, 2 or 3) whose last bead is to the right of the first, as in the training; else -1."""
    return -1 if start[-1, 0] < start[0, 0] else 1


def _stands_still(t: Times, distance: Array) -> bool:
    """Whether the distance (T,) has stopped changing."""
    later = distance[t >= t[-1] - _REST_TIME]
    return bool(t[-1] > 2 * _REST_TIME and np.ptp(later) < _REST_CHANGE)


def _doubts_about_the_end(t: Times, distance: Array, settled: float | None, t_end: float | None) -> list[str]:
    """Warnings about a forecast that does not end at the terminal shape, unless it was cut short."""
    off = f"{distance[-1]:.2g} L from the terminal shape, {SETTLED:g} L at most is settled"
    if settled is None and _stands_still(t, distance):
        return [f"the forecast comes to rest elsewhere: {off}"]
    if settled is None and t_end is None:
        return [f"the forecast has not settled by t={t[-1]:g}: {off}"]
    return []
