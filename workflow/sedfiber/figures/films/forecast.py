"""A forecast over the true fall: close up, along the whole path, and how large the error is."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from sedfiber.core.array_types import Array
from sedfiber.figures.falls import plane_path, plane_shapes
from sedfiber.figures.films.film import Beads, Film, RunningCurve, add_panel, blank_film, frame_samples
from sedfiber.figures.style import B_SYMBOL, BLACK, BLUE, GREY, ORANGE, VERMILION
from sedfiber.reduced.measures import forecast_error
from sedfiber.simulation.trajectory import Trajectory

_HEIGHT = 5.1  # inches
_CLOSE_UP = (0.42, 1.6, 3.1, 3.1)  # left, bottom, width and height of each panel, in inches
_PATH = (4.05, 1.6, 1.15, 3.1)
_ERRORS = (0.55, 0.42, 4.65, 0.75)
_KEYS = ((BLACK, 6.5), (VERMILION, 3.6))  # colour and size of each bead of the legend
_FIBERS = ((BLACK, 1.8), (VERMILION, 0.7))  # colour and line width in points along the path
_REACH = 1.12  # of L/2, on each side of the centre bead
_LEAST_E = 1e-16  # smaller errors are drawn here


def film_forecast(truth: Trajectory, forecast: Trajectory) -> Film:
    """Left: true fiber and forecast in the frame that falls with the true centre bead.  Right: the whole fall.
    Below: E(t) and its two parts.  Raises InputError when the two do not have the same samples."""
    errors = _errors(truth, forecast)
    figure = blank_film(_HEIGHT)
    figure.text(0.02, 0.97, _title(truth), fontsize=8.5)
    clock = figure.text(0.98, 0.97, "", fontsize=8.5, horizontalalignment="right")
    close_up = _CloseUp(add_panel(figure, *_CLOSE_UP), truth, forecast)
    path = _Path(add_panel(figure, *_PATH), truth, forecast)
    curves = _draw_errors(add_panel(figure, *_ERRORS), truth, errors)

    parts: list[Any] = [close_up, path, *curves]

    def show(sample: int) -> None:
        fallen = truth.centre[0, 1] - truth.centre[sample, 1]
        clock.set_text(f"t = {truth.t[sample]:.1f} a/U$_s$,  fallen {fallen:.0f} a")
        for part in parts:
            part.show(sample)

    moving = [clock, *close_up.artists, *path.lines, *(curve.line for curve in curves)]
    return Film(figure, moving, frame_samples(truth.t, plane_shapes(truth)), show)


class _CloseUp:
    """Beads to scale, relative to the true centre bead: the true ones black, the forecast's smaller over them."""

    def __init__(self, axes: Axes, truth: Trajectory, forecast: Trajectory) -> None:
        reach = _REACH * 0.5 * truth.length
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
        axes.set_title("relative to the true centre bead / a", loc="left", fontsize=7.5)
        self._shapes = [fall.positions[..., :2] - plane_path(truth)[:, None] for fall in (truth, forecast)]
        self._beads = [Beads(axes, truth.n_beads, 2.0, BLACK), Beads(axes, truth.n_beads, 1.1, VERMILION)]
        self.artists = [beads.artist for beads in self._beads]
        handles = [Line2D([], [], color=color, marker="o", linestyle="", markersize=size) for color, size in _KEYS]
        axes.legend(handles=handles, labels=["true", "forecast"], loc="upper left", handletextpad=0.1)

    def show(self, sample: int) -> None:
        """Move both fibers to this sample."""
        for beads, shapes in zip(self._beads, self._shapes, strict=True):
            beads.show(shapes[sample])


class _Path:
    """The true centre bead's whole path at one scale, and both fibers at their places."""

    def __init__(self, axes: Axes, truth: Trajectory, forecast: Trajectory) -> None:
        x, y = plane_path(truth).T
        axes.plot(x, y, color=GREY, linewidth=0.8)
        low = min(y.min(), forecast.centre[:, 1].min()) - 0.5 * truth.length
        high = y.max() + 0.5 * truth.length
        half = max(0.5 * (high - low) * _PATH[2] / _PATH[3], 0.5 * np.ptp(x) + 0.5 * truth.length)
        middle = 0.5 * (x.min() + x.max())
        axes.set(xlim=(middle - half, middle + half), ylim=(low, high), aspect="equal", adjustable="datalim")
        axes.tick_params(labelsize=6.5)
        axes.set_title("whole fall / a", loc="left", fontsize=7.5)
        self.lines = [axes.plot([], [], color=color, linewidth=width)[0] for color, width in _FIBERS]
        self._beads = truth.positions[..., :2], forecast.positions[..., :2]

    def show(self, sample: int) -> None:
        """Move both fibers to this sample."""
        for line, beads in zip(self.lines, self._beads, strict=True):
            line.set_data(*beads[sample].T)


def _errors(truth: Trajectory, forecast: Trajectory) -> dict[str, Array]:
    """E and its parts at every sample, (T,) each; there are none at t = 0."""
    error = forecast_error(truth.positions, forecast.positions)
    parts = {"E": error.total, r"$E_\mathrm{shape}$": error.shape, r"$E_\mathrm{pos}$": error.position}
    return {name: np.concatenate([[np.nan], np.maximum(part, _LEAST_E)]) for name, part in parts.items()}


def _draw_errors(axes: Axes, truth: Trajectory, errors: dict[str, Array]) -> list[RunningCurve]:
    axes.set(yscale="log", xlim=(0.0, truth.t[-1]), xlabel="time / (a/U$_s$)")
    axes.xaxis.labelpad = 1.0
    colors = (BLACK, BLUE, ORANGE)
    curves = [
        RunningCurve(axes, truth.t, values, color, label=name)
        for (name, values), color in zip(errors.items(), colors, strict=True)
    ]
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.95), ncols=3, fontsize=7.5, handlelength=1.2)
    return curves


def _title(truth: Trajectory) -> str:
    return f"{B_SYMBOL} = {truth.B:g}, k = {truth.angle_index}, test set {truth.split}"
