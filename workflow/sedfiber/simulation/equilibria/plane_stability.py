"""Is the fall stable in the plane?  The out-of-plane rate of the terminal shape, its zero, and runs in volume.

The terminal U attracts planar motion; a disturbance out of the plane grows on it at the leading
rate of ``transverse``.  ``threshold`` is the ℬ where that rate is zero.  ``watch`` releases the
fiber in volume with a small disturbance and measures the rate at which it grows or decays.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from sedfiber.core.array_types import Array, History, Times
from sedfiber.core.errors import InputError
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.parts import Disturbance
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.equilibria.transverse import leading_rate, transverse_matrix
from sedfiber.simulation.run import simulate
from sedfiber.simulation.settling import SETTLED, distance_to_terminal

THRESHOLD_ACCURACY = 1e-6  # of ℬ
_LINEAR = (1e-9, 0.3)  # a: between round-off and the start of nonlinear growth
_TIGHT = 1e-10


def terminal_rate(scene: Scene) -> float:
    """Leading out-of-plane rate in U_s/a on the terminal shape of ``scene``."""
    spatial = assemble(replace(scene, space="volume"))
    x = terminal_state(scene).positions
    return leading_rate(transverse_matrix(spatial, x), x)


def threshold(scene: Scene, low: float, high: float) -> float:
    """The ℬ between ``low`` and ``high`` where the terminal shape's rate is zero, to one part in 1e6.

    Raises InputError when the rate has the same sign at both ends.
    """

    def rate(log_B: float) -> float:
        return terminal_rate(replace(scene, B=float(np.exp(log_B))))

    ends = np.log([low, high])
    if rate(ends[0]) * rate(ends[1]) > 0.0:
        raise InputError(f"B: the out-of-plane rate has one sign from {low:g} to {high:g}; give a wider range")
    return float(np.exp(brentq(rate, *ends, xtol=THRESHOLD_ACCURACY)))


@dataclass(frozen=True)
class Growth:
    """Out-of-plane amplitude (T,) in a of a run in volume, and its rate in U_s/a where it is linear (or NaN)."""

    t: Times
    amplitude: Array
    rate: float


def watch(scene: Scene, amplitude: float, t_end: float) -> Growth:
    """Run ``scene`` in volume with every bead displaced out of the plane by up to ``amplitude``."""
    disturbed = replace(scene, space="volume", disturbance=Disturbance(amplitude))
    run = simulate(disturbed, Numerics(rtol=_TIGHT, atol=_TIGHT, interval=1.0), t_end)
    size, flattened = out_of_plane(run.shape)
    near = distance_to_terminal(flattened, terminal_state(scene).positions, scene.length) < SETTLED
    return Growth(run.t, size, _slope(run.t, size, near & (size > _LINEAR[0]) & (size < _LINEAR[1])))


def out_of_plane(shapes: History) -> tuple[Array, History]:
    """Root-mean-square distance (T,) from the vertical plane that fits best, and the shapes (T, N, 3) in that plane.

    ``shapes`` are relative to the centre bead, through which the plane goes.
    """
    flat = shapes[..., [0, 2]]
    spread = np.einsum("tik,til->tkl", flat, flat) / shapes.shape[1]
    squares, directions = np.linalg.eigh(spread)
    inside = np.zeros_like(shapes)
    inside[..., 0] = np.einsum("tik,tk->ti", flat, directions[..., 1])
    inside[..., 1] = shapes[..., 1]
    return np.sqrt(np.maximum(squares[:, 0], 0.0)), inside


def _slope(t: Times, size: Array, linear: Array) -> float:
    """Slope of ``log size`` over the last half of the linear stretch, where one mode is left; NaN without one."""
    samples = np.flatnonzero(linear)
    samples = samples[len(samples) // 2 :]
    return float(np.polyfit(t[samples], np.log(size[samples]), 1)[0]) if len(samples) >= 20 else float("nan")
