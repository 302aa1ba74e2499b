"""From a path in latent space to bead positions at any ascending times.

A decoded row costs as much as an evaluation of the rates, and the positions are smooth in time.
So SPAN steps of the path make a window, whose positions are decoded at the DEGREE + 1
Chebyshev–Lobatto nodes

    t_j = t_0 + ½ (t_1 − t_0) (1 − cos(π j/DEGREE))

and interpolated to its samples by the polynomial through them; a window with no more samples
than nodes is decoded at its samples instead. Neighbours share the node between them. The path
bends only a little at the mesh, by its own error, which is why a window may hold several steps.

    X = c(0) + (L/2) drift + U_term t + X_term + (L/2) Φᵀ (P₀ᵀ h + σ g(h))

A row holds the positions bead by bead, in two or in three dimensions as Φ has them.
"""

from typing import NamedTuple

import numpy as np

from sedfiber.core.array_types import Array, Times
from sedfiber.core.kernel_cache import kept
from sedfiber.reduced.compiled.copying import copy_rows
from sedfiber.reduced.compiled.network import Network
from sedfiber.reduced.compiled.perceptron import FAST, many

SPAN = 3
DEGREE = 8
BLOCK = 8  # windows decoded at a time: what the networks then need stays in the cache
PIECE = BLOCK * SPAN
ROWS = BLOCK * (DEGREE + 1)

NODES = 0.5 * (1.0 - np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE))
WEIGHTS = np.array([(-1.0) ** j * (0.5 if j in (0, DEGREE) else 1.0) for j in range(DEGREE + 1)])


class Shapes(NamedTuple):
    """What turns the latent state of one start into positions; W = N·dim, r modes, d latent variables.

    ``bias`` (1, w_1) and ``constant`` (r,) hold the decoder's ℬ, see `perceptron`; ``pick`` (d, r)
    is P₀ and ``modes`` (r, W) is (L/2) Φ. ``base`` (W,) is c(0) + X_term, ``velocity`` (dim,) is U_term.
    """

    network: Network
    bias: Array
    constant: Array
    pick: Array
    modes: Array
    base: Array
    velocity: Array
    half_length: float


class Scratch(NamedTuple):
    """Memory that the kernels write to: for rows of the network's precision, and for their states in float64."""

    work: Array
    latent: Array
    modal: Array
    rows: Array
    states: Array
    when: Array


def scratch(network: Network, n_modes: int, width: int, state: int) -> Scratch:
    """Memory for blocks of `positions`, in the precision of the network."""
    dtype = network.last.dtype
    widest = max(int(network.widths.max()), n_modes)
    return Scratch(
        np.empty((2, 2 * ROWS * widest), dtype),
        np.empty((ROWS, len(network.first)), dtype),
        np.empty((ROWS, n_modes), dtype),
        np.empty((ROWS, width), dtype),
        np.empty((ROWS, state)),
        np.empty(ROWS),
    )


@kept()
def write(
    shapes: Shapes,
    mesh: Times,
    path: Array,
    steps: int,
    t: Times,
    sample: int,
    last: bool,
    memory: Scratch,
    out: Array,
) -> tuple[int, int]:
    """Write the positions on a piece of a path into ``out`` (T, W), from the sample ``sample`` of ``t`` (T,) on.

    A piece has at most PIECE ``steps``; the last one takes all samples that are left. Returns the
    first sample of the next piece and the number of rows decoded.
    """
    windows, rows = (steps + SPAN - 1) // SPAN, 0
    bounds, row = np.empty(BLOCK + 1, np.int64), np.empty(BLOCK, np.int64)
    bounds[0] = sample
    for w in range(windows):
        left, right = mesh[w * SPAN], mesh[min(steps, (w + 1) * SPAN)]
        everything = last and w == windows - 1
        bounds[w + 1] = t.size if everything else bounds[w] + np.searchsorted(t[bounds[w] :], right)
        shared = w > 0 and _many(bounds, w - 1) and _many(bounds, w)
        row[w] = rows - 1 if shared else rows
        rows = _place(t[bounds[w] : bounds[w + 1]], left, right, shared, memory.when, rows)
    _states_at(memory.when[:rows], mesh, path, steps, memory.states)
    _decode(shapes, rows, memory)
    for w in range(windows):
        left, right = mesh[w * SPAN], mesh[min(steps, (w + 1) * SPAN)]
        times, target = t[bounds[w] : bounds[w + 1]], out[bounds[w] : bounds[w + 1]]
        if _many(bounds, w):
            _interpolate(memory.rows[row[w] : row[w] + DEGREE + 1], left, right, times, target)
        else:
            copy_rows(memory.rows[row[w] : row[w] + times.size], target)
    return bounds[windows], rows


@kept()
def _many(bounds, w):
    """Whether a window has more samples than nodes."""
    return bounds[w + 1] - bounds[w] > DEGREE + 1


@kept()
def _place(inside, left, right, shared, when, rows):
    """Append the times of a window's rows: its samples, or its nodes."""
    if inside.size <= DEGREE + 1:
        for s in range(inside.size):
            when[rows + s] = inside[s]
        return rows + inside.size
    skipped = 1 if shared else 0
    for j in range(skipped, DEGREE + 1):
        when[rows + j - skipped] = left + (right - left) * NODES[j]
    return rows + DEGREE + 1 - skipped


@kept()
def _states_at(when, mesh, path, steps, states):
    """States (rows, d + 2) at ascending times."""
    step = 0
    for s in range(when.size):
        while step < steps - 1 and mesh[step + 1] < when[s]:
            step += 1
        span = mesh[step + 1] - mesh[step]
        theta = (when[s] - mesh[step]) / span if span > 0.0 else 0.0  # a forecast of time 0 only
        c = path[step]
        for v in range(states.shape[1]):
            states[s, v] = c[0, v] + theta * (c[1, v] + theta * (c[2, v] + theta * (c[3, v] + theta * c[4, v])))


@kept(fastmath=FAST)
def _decode(shapes, rows, memory):
    """Positions (rows, W) of the states."""
    latent, modal, out = memory.latent[:rows], memory.modal[:rows], memory.rows[:rows]
    copy_rows(memory.states[:rows], latent)
    many(shapes.network, shapes.bias, latent, memory.work, modal)
    for s in range(rows):
        for m in range(modal.shape[1]):
            modal[s, m] -= shapes.constant[m]
        for v in range(latent.shape[1]):
            for m in range(modal.shape[1]):
                modal[s, m] += latent[s, v] * shapes.pick[v, m]
    np.dot(modal, shapes.modes, out)
    for s in range(rows):
        _carry(shapes, memory.states[s], memory.when[s], out[s])


@kept(fastmath=FAST)
def _carry(shapes, state, t, row):
    """Add the centre bead and the terminal shape; the drift is in the plane."""
    dim = shapes.velocity.size
    for i in range(dim):
        drift = shapes.half_length * state[state.size - 2 + i] if i < 2 else 0.0
        offset = drift + t * shapes.velocity[i]
        for j in range(i, row.size, dim):
            row[j] += shapes.base[j] + offset


@kept(fastmath=FAST, error_model="numpy")
def _interpolate(nodes, left, right, t, out):
    """Barycentric interpolation from nodes (DEGREE + 1, W) to samples (T, W)."""
    weights = np.empty(DEGREE + 1, nodes.dtype)
    n0, n1, n2, n3, n4, n5, n6, n7, n8 = (
        nodes[0],
        nodes[1],
        nodes[2],
        nodes[3],
        nodes[4],
        nodes[5],
        nodes[6],
        nodes[7],
        nodes[8],
    )
    for s in range(t.size):
        _lagrange((t[s] - left) / (right - left), weights)
        w0, w1, w2, w3, w4, w5, w6, w7, w8 = (
            weights[0],
            weights[1],
            weights[2],
            weights[3],
            weights[4],
            weights[5],
            weights[6],
            weights[7],
            weights[8],
        )
        row = out[s]
        for j in range(row.size):
            even = w0 * n0[j] + w2 * n2[j] + w4 * n4[j] + w6 * n6[j] + w8 * n8[j]
            row[j] = even + w1 * n1[j] + w3 * n3[j] + w5 * n5[j] + w7 * n7[j]


@kept(error_model="numpy")
def _lagrange(theta, weights):
    """Values at ``theta`` in [0, 1] of the polynomials that are 1 at one node and 0 at the others."""
    total = 0.0
    for j in range(DEGREE + 1):
        distance = theta - NODES[j]
        if distance == 0.0:
            for i in range(DEGREE + 1):
                weights[i] = 1.0 if i == j else 0.0
            return
        weights[j] = WEIGHTS[j] / distance
        total += WEIGHTS[j] / distance
    for j in range(DEGREE + 1):
        weights[j] = weights[j] / total
