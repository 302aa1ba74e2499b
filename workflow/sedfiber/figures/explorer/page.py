"""The explorer: a trained model and its simulated falls as one HTML page that needs nothing else.

The page's script integrates the reduced model in the browser, with the arrays, the Runge–Kutta pair and
the tolerances of `compiled`. Weights and terminal curve are embedded in float64, as that code uses them. Of each
simulated fall a few samples are kept: shapes relative to the centre bead as whole multiples of a quantum, 1e-3 a
for 31 beads, and the centre bead's path in float32.
"""

import base64
import html
import json
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.core.errors import InputError
from sedfiber.figures.data_sets import SETS
from sedfiber.figures.falls import plane_path, plane_shapes, snapshots
from sedfiber.reduced.compiled.model_file import read_model
from sedfiber.reduced.compiled.network import Network
from sedfiber.reduced.compiled.tableau import ERROR, EXTENSION, A
from sedfiber.reduced.compiled.tables import Encoder, Tables, Tensors, tables
from sedfiber.reduced.compiled.tolerances import ATOL, LEAST_ASYMMETRY, RTOL
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.reduced.forecaster import Forecaster, load_model
from sedfiber.reduced.scaling import Scales
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve
from sedfiber.simulation.settling import CONFIRMED, SETTLED, distance_to_terminal, settling_time
from sedfiber.simulation.trajectory import Trajectory

_PARTS = Path(__file__).parent
_FORECASTING = ("data", "model", "integrate", "forecast", "settling", "simulated", "scene")
_SHOWING = ("canvas", "fall_view", "error_view", "map_view", "numbers", "player", "controls", "main")
_SAMPLES = 56  # of each simulated fall, and these besides: the ends of a straight fiber bend at once
_EARLY = (1, 2, 4, 8)
_FEWEST_SAMPLES = 3  # for a parabola
_LARGEST = 2**15 - 1  # multiple of the quantum
_FLAT = 1e-6  # a: how far from the plane a planar fall may be


def explorer_page(folder: Path, datasets: Sequence[Path]) -> str:
    """The page for the model in ``folder`` and the falls of the data sets; raises InputError for what does not fit."""
    forecaster = load_model(folder)
    curve = forecaster.curve
    if curve is None:
        raise InputError(f"model: {folder} has no {CURVE} beside it; make it with solve_terminal_curve")
    given = [fall for path in datasets for fall in _falls_of(path, forecaster)]
    falls = [fall for fall in given if forecaster.covers(fall.B, fall.theta0) and curve.covers(fall.B)]
    if not falls:
        raise InputError(
            f"dataset: no fall is within the model's range ({forecaster.range_words()}); give some that are"
        )
    tensors, card = read_model(folder)
    return _filled_in(_data(forecaster, curve, tensors, falls), _words(forecaster, falls, len(given), card))


def _data(forecaster: Forecaster, curve: TerminalCurve, tensors: Tensors, falls: Sequence[Trajectory]) -> dict:
    """What the script reads; `embedded` in data.js."""
    half_length = forecaster.model.scales.half_length
    quantum = max(np.abs(plane_shapes(fall)).max() for fall in falls) / _LARGEST
    return {
        "model": _model(forecaster, tables(tensors, half_length, dim=2), Encoder(tensors, half_length)),
        "curve": _curve(curve),
        "method": _method(),
        "settling": {"settled": SETTLED, "confirmed": CONFIRMED},
        "sets": [{"split": split, "color": SETS[split][1], "name": SETS[split][2]} for split in _splits(falls)],
        "falls": [_fall(fall, curve, quantum) for fall in falls],
        "quantum": quantum,
    }


def _falls_of(path: Path, forecaster: Forecaster) -> list[Trajectory]:
    """The falls of a data set, all such that the page can show them."""
    falls = read_falls(path)
    for fall in falls:
        wrong = _misfit(fall, forecaster)
        if wrong:
            raise InputError(f"dataset: {str(path)!r}: {fall.name} {wrong}")
    return falls


def _misfit(fall: Trajectory, forecaster: Forecaster) -> str:
    """Why a fall does not belong on the page; empty for one that does."""
    n_beads = forecaster.model.scales.n_beads
    if fall.n_beads != n_beads:
        return f"has {fall.n_beads} beads, the model {n_beads}"
    if fall.split not in SETS:
        return f"is of the split {fall.split!r}, not of {', '.join(SETS)}"
    if len(fall.t) < _FEWEST_SAMPLES or not (np.isfinite(fall.t).all() and np.isfinite(fall.positions).all()):
        return f"has fewer than {_FEWEST_SAMPLES} samples or values that are not finite"
    return "leaves the plane z = 0" if np.abs(fall.positions[..., 2]).max() > _FLAT else ""


def _splits(falls: Sequence[Trajectory]) -> list[str]:
    """The splits there are, in the order of `SETS`."""
    there = {fall.split for fall in falls}
    return [split for split in SETS if split in there]


def _model(forecaster: Forecaster, arrays: Tables, encoder: Encoder) -> dict:
    """What the script calls the model: `readModel` in model.js."""
    scales = forecaster.model.scales
    change = [{"weights": _packed(weights), "bias": _packed(bias)} for weights, bias in encoder.change]
    return {
        "n_beads": scales.n_beads,
        "half_length": scales.half_length,
        "range": {"B_min": scales.B_min, "B_max": scales.B_max, "theta0_max": scales.theta0_max},
        "tilt": _tilt(scales),
        "encoder": {"matrix": _packed(encoder.matrix), "allowed": _packed(encoder.allowed), "change": change},
        "rates": _network(arrays.rates, arrays.rates_bias, arrays.rates_context),
        "damping": _packed(arrays.damping),
        "decoder": _network(arrays.decoder, arrays.decoder_bias, arrays.decoder_context),
        "pick": _packed(arrays.pick),
        "modes": _packed(arrays.modes),
    }


def _tilt(scales: Scales) -> float:
    """What a straight start at θ₀ = 0 is tilted by, in radians."""
    return Scene(scales.B_max, 0.0, scales.n_beads).start_angle


def _network(network: Network, bias: Array, context: Array) -> dict:
    """Layers with weights (w_k+1, w_k), the first with the bias that the context adds to."""
    layers, at = [(network.first.T, bias)], 0
    for n, m in pairwise(network.widths):
        layers.append((network.inner[at : at + n * m].reshape(n, m).T, network.inner[at + n * m : at + (n + 1) * m]))
        at += (n + 1) * m
    return {
        "layers": [{"weights": _packed(weights), "bias": _packed(shift)} for weights, shift in layers],
        "last": _packed(network.last),
        "context": _packed(context),
        "signs_in": network.signs_in.tolist(),
        "signs_out": network.signs_out.tolist(),
    }


def _curve(curve: TerminalCurve) -> dict:
    return {"range": {"B_min": curve.B_min, "B_max": curve.B_max}, "coefficients": _packed(curve.coefficients)}


def _method() -> dict:
    """The Runge–Kutta pair and its tolerances."""
    tolerances = {"rtol": RTOL, "atol": ATOL, "least_asymmetry": LEAST_ASYMMETRY}
    return {"A": A.tolist(), "error": ERROR.tolist(), "extension": EXTENSION.tolist(), **tolerances}


def _fall(fall: Trajectory, curve: TerminalCurve, quantum: float) -> dict:
    """A few samples of a fall, as many by time as by how far the beads move, and when it settled."""
    early = [s for s in _EARLY if s < len(fall.t)]
    shapes = plane_shapes(fall)
    kept = np.unique([*snapshots(fall.t, shapes, min(_SAMPLES, len(fall.t))), *early])
    settled = settling_time(fall.t, distance_to_terminal(fall.shape, curve(fall.B)[0], fall.length))
    return {
        "split": fall.split,
        "B": fall.B,
        "k": fall.angle_index,
        "theta0": fall.theta0,
        "settling_time": settled,
        "t": _packed(fall.t[kept], "float32"),
        "centre": _packed(plane_path(fall)[kept], "float32"),
        "shapes": _packed(np.rint(shapes[kept] / quantum), "int16"),
    }


def _packed(array: Array, kind: str = "float64") -> dict:
    """An array row by row, little-endian, in base64."""
    content = np.ascontiguousarray(array, np.dtype(kind).newbyteorder("<")).tobytes()
    return {"type": kind, "data": base64.b64encode(content).decode()}


def _words(forecaster: Forecaster, falls: Sequence[Trajectory], given: int, card: dict) -> dict[str, str]:
    """What the page says of the model and the falls, which may be fewer than were ``given``."""
    model, scales = forecaster.model, forecaster.model.scales
    counts = {split: sum(fall.split == split for fall in falls) for split in _splits(falls)}
    keys = [f'<span class="key" style="background: {SETS[split][1]}"></span>{SETS[split][2]}' for split in counts]
    sources = ", ".join(f"{SETS[split][2]} {count}" for split, count in counts.items())
    left_out = f"; {given - len(falls)} outside that range are not shown" if given > len(falls) else ""
    return {
        "latent_dim": str(model.latent_dim),
        "training_falls": str(counts.get("train", 0)),
        "length": f"{2 * scales.n_beads}",
        "tilt": f"{abs(_tilt(scales)):g}",
        "map_keys": "".join(f"<span>{key}</span>" for key in keys),
        "provenance": html.escape(
            f"{scales.n_beads} beads, {forecaster.hydrodynamics} hydrodynamics. Model {card['sha256'][:12]}, trained "
            f"for ℬ from {scales.B_min:g} to {scales.B_max:g} and |θ₀| up to {np.degrees(scales.theta0_max):g}°. "
            f"Simulated falls: {sources}{left_out}."
        ),
    }


def _filled_in(data: dict, words: dict[str, str]) -> str:
    """The template with style, words, script and data in their places."""
    content = {
        "style": _part("style.css"),
        **words,
        "script": "\n".join(_part(f"{name}.js") for name in (*_FORECASTING, *_SHOWING)),
        "data": json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c"),
    }
    page = _part("template.html")
    for name, text in content.items():
        page = page.replace(f"{{{{{name}}}}}", text)
    return page


def _part(name: str) -> str:
    return (_PARTS / name).read_text(encoding="utf-8")
