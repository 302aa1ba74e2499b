"""One start's path in latent space, by an adaptive Runge–Kutta pair with a continuous extension.

The state is [h (d), c − c(0) − U_term t (2)] in latent units and L/2; its rates are those of
`learning.neural_ode`, for one ℬ. A path is a mesh of times and, for each step between them, the
coefficients of the state in powers of θ = (t − t_k)/(t_k+1 − t_k). It is made piece by piece, so
that memory does not grow with the length of a forecast.
"""

from typing import NamedTuple

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.core.kernel_cache import kept
from sedfiber.reduced.compiled.copying import copy
from sedfiber.reduced.compiled.network import Network
from sedfiber.reduced.compiled.perceptron import FAST, one
from sedfiber.reduced.compiled.runge_kutta import continue_step, error_ratio, first_step, next_step, stage
from sedfiber.reduced.compiled.tableau import STAGES
from sedfiber.reduced.compiled.tolerances import LEAST_ASYMMETRY

MORE, DONE, NOT_FINITE, STUCK = range(4)  # what a piece ends with; the last two are failures


class Dynamics(NamedTuple):
    """Rates of one start: ``bias`` (w_1,) and ``constant`` (d + 2,) hold its ℬ, see `perceptron`.

    ``damping`` (d + 2,) is A's diagonal, then zeros; ``pace`` (d + 2,) multiplies the rates.
    """

    network: Network
    bias: Array
    constant: Array
    damping: Array
    pace: Array


class Progress(NamedTuple):
    """Where an integration stands: state ``y`` (n,), stages ``k`` (7, n), of which the first is the rate at y.

    ``clock`` (3,) is the time, the step to try next and the error ratio of the last accepted step;
    ``atol`` (n,) the absolute tolerance of each component.
    """

    y: Array
    k: Array
    clock: Array
    atol: Array


@kept(fastmath=FAST)
def rates(dynamics: Dynamics, y: Array, work: Array, out: Array) -> None:
    """dy/dt (d + 2,) of the state y (d + 2,)."""
    one(dynamics.network, dynamics.bias, y[: len(dynamics.network.first)], work, out)
    for v in range(y.size):
        out[v] = dynamics.pace[v] * (out[v] - dynamics.constant[v] - dynamics.damping[v] * y[v])


@kept()
def depart(dynamics: Dynamics, start: Array, rtol: float, atol: float, work: Array) -> Progress:
    """At time 0, with a first step from two evaluations; a trial step moves no component by more than 0.01."""
    k, moved = np.empty((STAGES, start.size)), np.empty(start.size)
    rates(dynamics, start, work, k[0])
    trial = 0.01 / max(1e-6, np.abs(k[0]).max())
    for v in range(start.size):
        moved[v] = start[v] + trial * k[0, v]
    rates(dynamics, moved, work, k[1])
    bounds = _bounds(start, len(dynamics.network.first), atol)
    return Progress(start.copy(), k, np.array([0.0, first_step(start, k[0], k[1], trial, rtol, bounds), 1.0]), bounds)


@kept()
def _bounds(start: Array, d: int, atol: float) -> Array:
    """Absolute tolerances (n,), tighter for the odd latent variables of a nearly symmetric start.

    Next to the unstable W, left–right asymmetry grows a thousandfold, and what is wrong with it grows
    alike: it must be small against the asymmetry itself.
    """
    n_odd, asymmetry = (d + 1) // 2, 0.0
    for v in range(n_odd):
        asymmetry = max(asymmetry, abs(start[v]))
    bounds = np.empty(start.size)
    for v in range(start.size):
        bounds[v] = atol * min(1.0, max(asymmetry, LEAST_ASYMMETRY)) if v < n_odd else atol
    return bounds


@kept()
def advance(
    dynamics: Dynamics,
    progress: Progress,
    t_end: float,
    rtol: float,
    work: Array,
    mesh: Array,
    path: Array,
) -> tuple[int, int, int]:
    """Go on until ``t_end`` or until ``path`` (most steps, 5, n) is full; ``mesh`` has one entry more.

    Returns what the piece ends with, its steps, and the evaluations. ``work`` is for `one`.
    """
    end, steps, evaluations, status = np.empty(progress.y.size), 0, 0, MORE
    mesh[0] = progress.clock[0]
    while status == MORE and steps < len(path):
        clip(progress.clock, t_end)
        for i in range(1, STAGES):
            stage(i, progress.y, progress.k, progress.clock[1], end)
            rates(dynamics, end, work, progress.k[i])
        evaluations += STAGES - 1
        accepted, status = judge(progress, end, t_end, rtol, path[steps])
        if accepted:
            steps += 1
            mesh[steps] = progress.clock[0]
    return status, steps, evaluations


@kept()
def clip(clock: Array, t_end: float) -> None:
    """Let the next step end at ``t_end``, where it would go beyond or just short of it."""
    if clock[0] + 1.001 * clock[1] >= t_end:
        clock[1] = t_end - clock[0]


@kept()
def judge(progress: Progress, end: Array, t_end: float, rtol: float, piece: Array) -> tuple[bool, int]:
    """Accept the step that ends at ``end`` and write its polynomial to ``piece``, or reject it; choose the next."""
    y, k, clock = progress.y, progress.k, progress.clock
    t, step = clock[0], clock[1]
    ratio = error_ratio(y, end, k, step, rtol, progress.atol)
    if not np.isfinite(ratio):
        return False, NOT_FINITE
    clock[1] = next_step(step, ratio, clock[2])
    if ratio > 1.0:
        return False, STUCK if t + 1e-3 * step == t else MORE
    continue_step(y, k, step, piece)
    copy(end, y)
    copy(k[STAGES - 1], k[0])
    done = t + 1.0001 * step >= t_end
    clock[0], clock[2] = t_end if done else t + step, ratio
    return True, DONE if done else MORE
