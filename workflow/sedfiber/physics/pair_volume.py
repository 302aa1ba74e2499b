"""Sums over bead pairs in volume: ``pair_plane`` with a third coordinate."""

import numpy as np

from sedfiber.core.array_types import Array, Band, Matrix, Positions
from sedfiber.physics.kernel import kernel
from sedfiber.physics.pair_forms import FAST, REACH, coefficients


@kernel()
def _rows(x: Positions, force: Positions) -> Array:
    """``x, y, z, Fx, Fy, Fz`` as contiguous rows, shape (6, N)."""
    rows = np.empty((6, x.shape[0]))
    for j in range(x.shape[0]):
        rows[0, j], rows[1, j], rows[2, j] = x[j, 0], x[j, 1], x[j, 2]
        rows[3, j], rows[4, j], rows[5, j] = force[j, 0], force[j, 1], force[j, 2]
    return rows


@kernel(fastmath=FAST)
def velocities(x: Positions, force: Positions, form: int, u: Positions) -> None:
    """``u = M(x) F``, shape (N, 3)."""
    n = x.shape[0]
    rows = _rows(x, force)
    # the sum over all j takes the bead itself for one at distance 1
    own = 1.0 - coefficients(1.0, form)[0]
    for i in range(n):
        ux = uy = uz = 0.0
        for j in range(n):
            rx = x[i, 0] - rows[0, j]
            ry = x[i, 1] - rows[1, j]
            rz = x[i, 2] - rows[2, j]
            c1, e2, _, _ = coefficients(rx * rx + ry * ry + rz * rz, form)
            p = e2 * (rx * rows[3, j] + ry * rows[4, j] + rz * rows[5, j])
            ux += c1 * rows[3, j] + p * rx
            uy += c1 * rows[4, j] + p * ry
            uz += c1 * rows[5, j] + p * rz
        u[i, 0] = ux + own * force[i, 0]
        u[i, 1] = uy + own * force[i, 1]
        u[i, 2] = uz + own * force[i, 2]


@kernel(fastmath=FAST)
def linearise(x: Positions, force: Positions, band: Band, form: int, u: Positions, jac: Matrix) -> None:
    """Write ``M F`` to ``u`` and add ``M ∂F/∂x + (∂M/∂x) F`` to ``jac``, at least (3N, 3N)."""
    n = x.shape[0]
    rows = _rows(x, force)
    m = np.zeros((6, n + 2 * REACH))  # M_ij: xx, xy, xz, yy, yz, zz; beads beyond the ends are zeros
    g = np.empty((9, n))  # row i of the result, as the block of bead j is read
    for i in range(n):
        _pair_row(x, rows, i, form, m, g)
        ux = uy = uz = 0.0
        for j in range(n):
            fx, fy, fz = rows[3, j], rows[4, j], rows[5, j]
            ux += m[0, j + REACH] * fx + m[1, j + REACH] * fy + m[2, j + REACH] * fz
            uy += m[1, j + REACH] * fx + m[3, j + REACH] * fy + m[4, j + REACH] * fz
            uz += m[2, j + REACH] * fx + m[4, j + REACH] * fy + m[5, j + REACH] * fz
        u[i, 0], u[i, 1], u[i, 2] = ux, uy, uz
        for o in range(2 * REACH + 1):
            for w in range(3):
                for j in range(n):
                    kx, ky, kz = band[o, 0, w, j], band[o, 1, w, j], band[o, 2, w, j]
                    g[w, j] += m[0, j + o] * kx + m[1, j + o] * ky + m[2, j + o] * kz
                    g[3 + w, j] += m[1, j + o] * kx + m[3, j + o] * ky + m[4, j + o] * kz
                    g[6 + w, j] += m[2, j + o] * kx + m[4, j + o] * ky + m[5, j + o] * kz
        for j in range(n):
            for k in range(3):
                for w in range(3):
                    jac[3 * i + k, 3 * j + w] += g[3 * k + w, j]


@kernel(fastmath=FAST)
def _pair_row(x, rows, i, form, m, g):
    """Bead i with every bead: its row of ``M`` into ``m`` and of ``(∂M/∂x) F`` into ``g`` (see pair_plane)."""
    own = np.zeros(9)
    for j in range(x.shape[0]):
        rx = x[i, 0] - rows[0, j]
        ry = x[i, 1] - rows[1, j]
        rz = x[i, 2] - rows[2, j]
        fx = rows[3, j]
        fy = rows[4, j]
        fz = rows[5, j]
        c1, e2, d1, d2 = coefficients(rx * rx + ry * ry + rz * rz, form)
        s = rx * fx + ry * fy + rz * fz
        t = d2 * s
        m[0, j + REACH] = c1 + e2 * rx * rx
        m[1, j + REACH] = e2 * rx * ry
        m[2, j + REACH] = e2 * rx * rz
        m[3, j + REACH] = c1 + e2 * ry * ry
        m[4, j + REACH] = e2 * ry * rz
        m[5, j + REACH] = c1 + e2 * rz * rz
        g[0, j] = -(d1 * fx * rx + t * rx * rx + e2 * (rx * fx + s))
        g[1, j] = -(d1 * fx * ry + t * rx * ry + e2 * rx * fy)
        g[2, j] = -(d1 * fx * rz + t * rx * rz + e2 * rx * fz)
        g[3, j] = -(d1 * fy * rx + t * ry * rx + e2 * ry * fx)
        g[4, j] = -(d1 * fy * ry + t * ry * ry + e2 * (ry * fy + s))
        g[5, j] = -(d1 * fy * rz + t * ry * rz + e2 * ry * fz)
        g[6, j] = -(d1 * fz * rx + t * rz * rx + e2 * rz * fx)
        g[7, j] = -(d1 * fz * ry + t * rz * ry + e2 * rz * fy)
        g[8, j] = -(d1 * fz * rz + t * rz * rz + e2 * (rz * fz + s))
    for k in range(9):
        for j in range(x.shape[0]):
            own[k] -= g[k, j]
        g[k, i] += own[k]
    m[0, i + REACH] = 1.0
    m[3, i + REACH] = 1.0
    m[5, i + REACH] = 1.0
