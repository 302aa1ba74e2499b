"""Forecasts of many starts together: one product of matrices a layer for all of them.

A fixed number of lanes is advanced in lock step, each lane with a start and a step size of its
own; a lane whose forecast is done takes the next start. So a start's steps do not depend on its
companions, but for rounding. Rates are evaluated and positions decoded in the precision of the
tables that are given; the state and the control of its error stay in float64.
"""

from typing import NamedTuple

import numpy as np
from numba import literal_unroll

from sedfiber.core.array_types import Array, Times
from sedfiber.core.kernel_cache import kept
from sedfiber.reduced.compiled.bead_path import PIECE, Scratch, Shapes, write
from sedfiber.reduced.compiled.begin import dynamics_of, first_state, shapes_of
from sedfiber.reduced.compiled.copying import copy
from sedfiber.reduced.compiled.latent_path import DONE, Progress, clip, depart, judge
from sedfiber.reduced.compiled.network import Network
from sedfiber.reduced.compiled.origin import Origin
from sedfiber.reduced.compiled.perceptron import many
from sedfiber.reduced.compiled.runge_kutta import stage
from sedfiber.reduced.compiled.tableau import DEGREE, STAGES
from sedfiber.reduced.compiled.tables import Tables

LANES = 48  # few enough that what they need stays in the cache
SMALLEST_ATOL = (10 * float(np.finfo(np.float32).eps), 0.0)  # of rates in float32 and float64: above rounding


class Work(NamedTuple):
    """The networks and modes in the precision to compute in, and memory for their rows."""

    rates: Network
    decoder: Network
    modes: Array
    latent: Array
    raw: Array
    layers: Array
    memory: Scratch


class Lanes(NamedTuple):
    """What each lane holds, one row a lane: see `Dynamics`, `Progress` and `Shapes` for the arrays of their names.

    ``counters`` (lanes, 3) are the start, the steps in its piece of path and its next sample;
    ``mesh`` and ``path`` are that piece.
    """

    counters: Array
    mesh: Array
    path: Array
    y: Array
    k: Array
    clock: Array
    atol: Array
    bias: Array
    constant: Array
    pace: Array
    shape_bias: Array
    shape_constant: Array
    base: Array
    velocity: Array


def lanes_for(work: Work, count: int) -> Lanes:
    """Memory for so many lanes."""
    n, dtype = work.raw.shape[1], work.modes.dtype

    def room(*size: int) -> Array:
        return np.zeros((count, *size))

    return Lanes(
        counters=np.zeros((count, 3), np.int64),
        mesh=room(PIECE + 1),
        path=room(PIECE, DEGREE + 1, n),
        y=room(n),
        k=room(STAGES, n),
        clock=room(3),
        atol=room(n),
        bias=np.zeros((count, work.rates.widths[0]), dtype),
        constant=room(n),
        pace=room(n),
        shape_bias=np.zeros((count, 1, work.decoder.widths[0]), dtype),
        shape_constant=room(work.modes.shape[0]),
        base=room(work.modes.shape[1]),
        velocity=room(2),
    )


class Sweep(NamedTuple):
    """Starts as arrays over the first axis: `Origin` s has row s of each, and of ``encoders`` the row ``which[s]``.

    Start s has the samples 0, …, counts[s] − 1 of ``t`` and the rows from ``offsets[s]`` on of the output.
    """

    encoders: Array
    which: Array
    b: Array
    anchor: Array
    initial: Array
    terminal: Array
    velocity: Array
    pace: Array
    t: Times
    counts: Array
    offsets: Array


@kept()
def sweep(
    tables: Tables, work: Work, lanes: Lanes, starts: Sweep, rtol: float, atol: float, out: Array
) -> tuple[int, int, float, int, int]:
    """Write all positions into ``out`` (sum counts, W).

    Returns what the integrations ended with, at which start and time when one failed, the
    evaluations of the rates, and the rows decoded.
    """
    alone = np.empty((2, 2 * max(tables.rates.widths.max(), tables.decoder.widths.max())))
    end = np.empty(lanes.y.shape)
    active = queued = evaluations = decoded = 0
    while True:
        while active < len(end) and queued < len(starts.b):
            _begin(tables, work, lanes, active, starts, queued, rtol, atol, alone)
            active, queued, evaluations = active + 1, queued + 1, evaluations + 2
        if active == 0:
            return DONE, 0, 0.0, evaluations, decoded
        _step(tables, work, lanes, active, starts, end)
        evaluations += active * (STAGES - 1)
        for s in range(active - 1, -1, -1):
            status = _judge(lanes, s, starts, end[s], rtol)
            if status > DONE:
                return status, lanes.counters[s, 0], lanes.clock[s, 0], evaluations, decoded
            if status == DONE or lanes.counters[s, 1] == PIECE:
                decoded += _write(tables, work, lanes, s, starts, status == DONE, out)
            if status == DONE:
                active -= 1
                _move(lanes, active, s)


@kept()
def _begin(tables, work, lanes, s, starts, which, rtol, atol, alone):
    """Put a start into lane ``s``."""
    origin = Origin(
        starts.encoders[starts.which[which]],
        starts.b[which],
        starts.anchor[which],
        starts.initial[which],
        starts.terminal[which],
        starts.velocity[which],
        starts.pace[which],
    )
    dynamics, state = dynamics_of(tables, origin, alone), first_state(origin)
    shapes = shapes_of(tables, work.decoder, work.modes, origin, alone)
    progress = depart(dynamics, state, rtol, atol, alone)
    copy(progress.y, lanes.y[s])
    copy(progress.k[0], lanes.k[s, 0])
    copy(progress.clock, lanes.clock[s])
    for v in range(progress.atol.size):
        lanes.atol[s, v] = max(progress.atol[v], SMALLEST_ATOL[work.modes.itemsize // 4 - 1])
    copy(dynamics.bias, lanes.bias[s])
    copy(dynamics.constant, lanes.constant[s])
    copy(dynamics.pace, lanes.pace[s])
    copy(shapes.bias[0], lanes.shape_bias[s, 0])
    copy(shapes.constant, lanes.shape_constant[s])
    copy(shapes.base, lanes.base[s])
    copy(shapes.velocity, lanes.velocity[s])
    lanes.counters[s, 0], lanes.counters[s, 1], lanes.counters[s, 2], lanes.mesh[s, 0] = which, 0, 0, 0.0


@kept()
def _step(tables, work, lanes, active, starts, end):
    """All stages of a step of every lane; ``end`` becomes their states after it."""
    for s in range(active):
        clip(lanes.clock[s], starts.t[starts.counts[lanes.counters[s, 0]] - 1])
    for i in range(1, STAGES):
        for s in range(active):
            stage(i, lanes.y[s], lanes.k[s], lanes.clock[s, 1], end[s])
            for v in range(work.latent.shape[1]):
                work.latent[s, v] = end[s, v]
        many(work.rates, lanes.bias[:active], work.latent[:active], work.layers, work.raw[:active])
        for s in range(active):
            for v in range(end.shape[1]):
                damped = tables.damping[v] * end[s, v] if v < tables.damping.size else 0.0
                lanes.k[s, i, v] = lanes.pace[s, v] * (work.raw[s, v] - lanes.constant[s, v] - damped)


@kept()
def _judge(lanes, s, starts, end, rtol):
    """Accept or reject the step of lane ``s``."""
    counters, t_end = lanes.counters[s], starts.t[starts.counts[lanes.counters[s, 0]] - 1]
    progress = Progress(lanes.y[s], lanes.k[s], lanes.clock[s], lanes.atol[s])
    accepted, status = judge(progress, end, t_end, rtol, lanes.path[s, counters[1]])
    if accepted:
        counters[1] += 1
        lanes.mesh[s, counters[1]] = lanes.clock[s, 0]
    return status


@kept()
def _write(tables, work, lanes, s, starts, last, out):
    """Positions on the piece of path that lane ``s`` has filled; returns the rows decoded."""
    counters, own = lanes.counters[s], (tables.pick, work.modes, lanes.base[s], lanes.velocity[s], tables.half_length)
    shapes = Shapes(work.decoder, lanes.shape_bias[s], lanes.shape_constant[s], *own)
    start = counters[0]
    t, rows = starts.t[: starts.counts[start]], out[starts.offsets[start] : starts.offsets[start + 1]]
    sample, decoded = write(shapes, lanes.mesh[s], lanes.path[s], counters[1], t, counters[2], last, work.memory, rows)
    counters[1], counters[2], lanes.mesh[s, 0] = 0, sample, lanes.clock[s, 0]
    return decoded


@kept()
def _move(lanes, last, s):
    """Put the last lane in the place of ``s``, so that the active ones are the first."""
    for array in literal_unroll(lanes):
        copy(array[last].ravel(), array[s].ravel())  # views: the lanes are contiguous
