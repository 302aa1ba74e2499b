"""Sums over bead pairs in the plane, for any mobility of ``pair_forms``.

Each bead sums over all others, coordinate by coordinate from contiguous rows, so that four
pairs are worked on at a time; using a pair for both its beads would need half the pairs and
twice the time.
"""

import numpy as np

from sedfiber.core.array_types import Array, Band, Matrix, Positions
from sedfiber.physics.kernel import kernel
from sedfiber.physics.pair_forms import FAST, REACH, coefficients


@kernel()
def _rows(x: Positions, force: Positions) -> Array:
    """``x, y, Fx, Fy`` as contiguous rows, shape (4, N)."""
    rows = np.empty((4, x.shape[0]))
    for j in range(x.shape[0]):
        rows[0, j], rows[1, j] = x[j, 0], x[j, 1]
        rows[2, j], rows[3, j] = force[j, 0], force[j, 1]
    return rows


@kernel(fastmath=FAST)
def velocities(x: Positions, force: Positions, form: int, u: Positions) -> None:
    """``u = M(x) F``, shape (N, 2)."""
    n = x.shape[0]
    rows = _rows(x, force)
    # the sum over all j takes the bead itself for one at distance 1
    own = 1.0 - coefficients(1.0, form)[0]
    for i in range(n):
        ux = 0.0
        uy = 0.0
        for j in range(n):
            rx = x[i, 0] - rows[0, j]
            ry = x[i, 1] - rows[1, j]
            c1, e2, _, _ = coefficients(rx * rx + ry * ry, form)
            p = e2 * (rx * rows[2, j] + ry * rows[3, j])
            ux += c1 * rows[2, j] + p * rx
            uy += c1 * rows[3, j] + p * ry
        u[i, 0] = ux + own * force[i, 0]
        u[i, 1] = uy + own * force[i, 1]


@kernel(fastmath=FAST)
def linearise(x: Positions, force: Positions, band: Band, form: int, u: Positions, jac: Matrix) -> None:
    """Write ``M F`` to ``u`` and add ``M ∂F/∂x + (∂M/∂x) F`` to ``jac``, at least (2N, 2N).

    With ``s = r·F_j``, ``e2 = c2/r²``, ``d1 = c1'/r`` and ``d2 = e2'/r`` one pair contributes
    ``c1 F_j + e2 s r`` to the velocity of bead i, whose derivative with respect to ``r`` is
    ``g = d1 F rᵀ + d2 s r rᵀ + e2 (s I + r Fᵀ)``.
    """
    n = x.shape[0]
    rows = _rows(x, force)
    m = np.zeros((3, n + 2 * REACH))  # M_ij: xx, xy, yy; beads beyond the ends are zeros
    g = np.empty((4, n))  # row i of the result: xx, xy, yx, yy
    for i in range(n):
        oxx = oxy = oyx = oyy = 0.0
        for j in range(n):
            rx = x[i, 0] - rows[0, j]
            ry = x[i, 1] - rows[1, j]
            fx = rows[2, j]
            fy = rows[3, j]
            c1, e2, d1, d2 = coefficients(rx * rx + ry * ry, form)
            s = rx * fx + ry * fy
            t = d2 * s
            m[0, j + REACH] = c1 + e2 * rx * rx
            m[1, j + REACH] = e2 * rx * ry
            m[2, j + REACH] = c1 + e2 * ry * ry
            gxx = d1 * fx * rx + t * rx * rx + e2 * (rx * fx + s)
            gxy = d1 * fx * ry + t * rx * ry + e2 * rx * fy
            gyx = d1 * fy * rx + t * rx * ry + e2 * ry * fx
            gyy = d1 * fy * ry + t * ry * ry + e2 * (ry * fy + s)
            g[0, j], g[1, j], g[2, j], g[3, j] = -gxx, -gxy, -gyx, -gyy
            oxx += gxx
            oxy += gxy
            oyx += gyx
            oyy += gyy
        g[0, i] += oxx
        g[1, i] += oxy
        g[2, i] += oyx
        g[3, i] += oyy
        m[0, i + REACH] = 1.0
        m[2, i + REACH] = 1.0
        ux = uy = 0.0
        for j in range(n):
            ux += m[0, j + REACH] * rows[2, j] + m[1, j + REACH] * rows[3, j]
            uy += m[1, j + REACH] * rows[2, j] + m[2, j + REACH] * rows[3, j]
        u[i, 0] = ux
        u[i, 1] = uy
        for o in range(2 * REACH + 1):
            for j in range(n):
                mxx, mxy, myy = m[0, j + o], m[1, j + o], m[2, j + o]
                g[0, j] += mxx * band[o, 0, 0, j] + mxy * band[o, 1, 0, j]
                g[1, j] += mxx * band[o, 0, 1, j] + mxy * band[o, 1, 1, j]
                g[2, j] += mxy * band[o, 0, 0, j] + myy * band[o, 1, 0, j]
                g[3, j] += mxy * band[o, 0, 1, j] + myy * band[o, 1, 1, j]
        for j in range(n):
            jac[2 * i, 2 * j] += g[0, j]
            jac[2 * i, 2 * j + 1] += g[1, j]
            jac[2 * i + 1, 2 * j] += g[2, j]
            jac[2 * i + 1, 2 * j + 1] += g[3, j]
