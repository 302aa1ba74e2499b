"""What one start makes of the tables: its latent state, and both networks at its ℬ."""

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.core.kernel_cache import kept
from sedfiber.reduced.compiled.bead_path import Shapes
from sedfiber.reduced.compiled.copying import copy
from sedfiber.reduced.compiled.latent_path import Dynamics
from sedfiber.reduced.compiled.network import Network
from sedfiber.reduced.compiled.origin import Origin
from sedfiber.reduced.compiled.perceptron import one
from sedfiber.reduced.compiled.tables import Tables


@kept()
def first_state(origin: Origin) -> Array:
    """State [h, 0, 0] (d + 2,) at time 0."""
    centre, d = origin.initial.shape[0] // 2, len(origin.encoder)
    n_beads, state = len(origin.initial), np.zeros(d + 2)
    residual = np.empty(3 * n_beads)
    for i in range(n_beads):
        for j in range(3):
            residual[3 * i + j] = origin.initial[i, j] - origin.initial[centre, j] - origin.terminal[i, j]
    copy(np.dot(origin.encoder, residual), state)
    return state


@kept()
def _context(origin):
    """[b, h_term] (1 + d,)."""
    context = np.empty(len(origin.encoder) + 1)
    context[0] = origin.b
    copy(np.dot(origin.encoder, origin.anchor.ravel()), context[1:])
    return context


@kept()
def dynamics_of(tables: Tables, origin: Origin, work: Array) -> Dynamics:
    """The rates at the start's ℬ."""
    n, d = len(tables.rates.signs_out), len(tables.damping)
    bias = tables.rates_bias + np.dot(tables.rates_context, _context(origin))
    constant, damping, pace = np.empty(n), np.zeros(n), np.ones(n)
    one(tables.rates, bias, np.zeros(d), work, constant)
    for v in range(d):
        damping[v], pace[v] = tables.damping[v], origin.pace
    return Dynamics(tables.rates, bias, constant, damping, pace)


@kept()
def shapes_of(tables: Tables, decoder: Network, modes: Array, origin: Origin, work: Array) -> Shapes:
    """The decoder at the start's ℬ; ``decoder`` and ``modes`` are those of ``tables`` in any precision."""
    bias = tables.decoder_bias + np.dot(tables.decoder_context, _context(origin))
    constant = np.empty(len(tables.decoder.signs_out))
    one(tables.decoder, bias, np.zeros(len(tables.damping)), work, constant)
    n_beads = origin.initial.shape[0]
    dim = modes.shape[1] // n_beads
    base = np.empty(n_beads * dim)
    for i in range(n_beads):
        for j in range(dim):
            base[i * dim + j] = origin.initial[n_beads // 2, j] + origin.terminal[i, j]
    row = bias.astype(modes.dtype).reshape(1, bias.size)
    return Shapes(decoder, row, constant, tables.pick, modes, base, origin.velocity[:dim].copy(), tables.half_length)
