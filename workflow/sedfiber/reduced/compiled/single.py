"""The forecast of one start, as one compiled call."""

import numpy as np

from sedfiber.core.array_types import Array, Times
from sedfiber.core.kernel_cache import kept
from sedfiber.reduced.compiled.bead_path import PIECE, Scratch, write
from sedfiber.reduced.compiled.begin import dynamics_of, first_state, shapes_of
from sedfiber.reduced.compiled.latent_path import DONE, MORE, advance, depart
from sedfiber.reduced.compiled.origin import Origin
from sedfiber.reduced.compiled.tableau import DEGREE
from sedfiber.reduced.compiled.tables import Tables


@kept()
def forecast(
    tables: Tables, origin: Origin, t: Times, rtol: float, atol: float, memory: Scratch, out: Array
) -> tuple[int, float, int, int]:
    """Write positions at times ``t`` (T,) into ``out`` (T, W).

    Returns what the integration ended with and when, the evaluations of the rates, and the rows decoded.
    """
    work = np.empty((2, 2 * max(tables.rates.widths.max(), tables.decoder.widths.max())))
    state, dynamics = first_state(origin), dynamics_of(tables, origin, work)
    shapes = shapes_of(tables, tables.decoder, tables.modes, origin, work)
    mesh, path = np.empty(PIECE + 1), np.empty((PIECE, DEGREE + 1, state.size))
    progress, status, evaluations, sample, decoded = depart(dynamics, state, rtol, atol, work), MORE, 2, 0, 0
    while status == MORE:
        status, steps, used = advance(dynamics, progress, t[-1], rtol, work, mesh, path)
        evaluations += used
        if status <= DONE:
            sample, rows = write(shapes, mesh, path, steps, t, sample, status == DONE, memory, out)
            decoded += rows
    return status, progress.clock[0], evaluations, decoded
