"""Between positions and the state that is integrated: compiled, since every right-hand side needs them."""

import numpy as np

from sedfiber.core.array_types import Array, Band, Matrix, Positions, State
from sedfiber.physics.kernel import kernel


@kernel()
def open_state(y: State, x: Positions, force: Positions) -> None:
    """Turn a state into positions relative to the centre bead, ``x`` (N, d), and clear the forces."""
    n, d = x.shape
    for i in range(n):
        for k in range(d):
            x[i, k] = y[i * d + k]
            force[i, k] = 0.0
    for k in range(d):
        x[n // 2, k] = 0.0


@kernel()
def rates(u: Positions, force: Positions, out: State) -> None:
    """``dy/dt`` from bead velocities and the forces whose work is counted, into ``out`` (N d + 1,)."""
    n, d = u.shape
    power = 0.0
    for i in range(n):
        for k in range(d):
            power += force[i, k] * u[i, k]
            out[i * d + k] = u[i, k] - u[n // 2, k]
    for k in range(d):
        out[n // 2 * d + k] = u[n // 2, k]
    out[n * d] = power


@kernel()
def add_work_row(u: Positions, force: Positions, band: Band, jac: Matrix) -> None:
    """Add ``∂(F·u)/∂x = uᵀ ∂F/∂x + Fᵀ ∂u/∂x`` to the last row of ``jac`` (N d + 1, N d + 1)."""
    n, d = u.shape
    reach = band.shape[0] // 2
    last = jac[n * d]
    for i in range(n):
        for k in range(d):
            row = jac[i * d + k]
            for c in range(n * d):
                last[c] += force[i, k] * row[c]
    for j in range(n):
        for o in range(max(0, reach - j), min(2 * reach + 1, n + reach - j)):
            for v in range(d):
                for w in range(d):
                    last[j * d + w] += u[j + o - reach, v] * band[o, v, w, j]


@kernel()
def to_centre_frame(jac: Matrix, shape: tuple, needs_lab_frame: bool) -> None:
    """Turn ``∂(u, Ẇ)/∂x`` into ``∂(dy/dt)/∂y`` in place, (N d + 1, N d + 1).

    Moving the centre bead's entry moves all beads: its columns are the sum of all columns of a
    coordinate, which is zero when nothing depends on the place.
    """
    n, d = shape
    centre = n // 2 * d
    for r in range(n * d + 1):
        for k in range(d):
            total = 0.0
            if needs_lab_frame:
                for j in range(n):
                    total += jac[r, j * d + k]
            jac[r, centre + k] = total
    for i in range(n):
        for k in range(d):
            if i * d != centre:
                for c in range(n * d):
                    jac[i * d + k, c] -= jac[centre + k, c]


def no_band(shape: tuple[int, int]) -> Array:
    """A band without entries for beads ``shape = (N, d)``."""
    return np.zeros((5, shape[1], shape[1], shape[0]))
