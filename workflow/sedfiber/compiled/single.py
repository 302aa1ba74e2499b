"""The forecast of one start, as one compiled call."""

import numpy as np
from numba import njit

from sedfiber._typing import Array, Times
from sedfiber.compiled.bead_path import PIECE, Scratch, write
from sedfiber.compiled.begin import dynamics_of, first_state, shapes_of
from sedfiber.compiled.latent_path import DONE, MORE, advance, depart
from sedfiber.compiled.origin import Origin
from sedfiber.compiled.tableau import DEGREE
from sedfiber.compiled.tables import Tables


@njit(cache=True)
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
