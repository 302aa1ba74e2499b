"""The study's scene as two kernels written for it alone: the yardstick for what parts cost.

Gravity, springs, bending and plain Rotne–Prager in the plane, from the state to its rate and
its Jacobian, each in one compiled function without a call, a choice or an array that another
scene would need.  The equations are those of ``physics``; nothing is shared with it.
"""

import numpy as np

from sedfiber.core.array_types import Matrix, State
from sedfiber.physics.kernel import kernel

FAST = {"reassoc", "contract", "nsz", "arcp"}


@kernel(fastmath=FAST)
def rhs(y: State, modulus: float) -> State:
    """``dy/dt`` (2N + 1,) of the study's scene; see ``physics.system`` for the state."""
    n = (y.size - 1) // 2
    centre = n // 2
    x = np.empty((2, n))
    f = np.empty((2, n))
    _positions_and_weight(y, x, f)
    _add_elastic_force(x, modulus, f)
    out = np.empty(y.size)
    power = 0.0
    for i in range(n):
        ux = -0.25 * f[0, i]  # the sum takes the bead itself for one at distance 1
        uy = -0.25 * f[1, i]
        for j in range(n):
            rx = x[0, i] - x[0, j]
            ry = x[1, i] - x[1, j]
            r2 = rx * rx + ry * ry
            q2 = 1.0 / (r2 if r2 > 0.0 else 1.0)
            q = q2**0.5
            a = 0.75 * q
            b = 0.5 * q * q2
            p = (a - 3.0 * b) * q2 * (rx * f[0, j] + ry * f[1, j])
            ux += (a + b) * f[0, j] + p * rx
            uy += (a + b) * f[1, j] + p * ry
        out[2 * i] = ux
        out[2 * i + 1] = uy
        power += f[0, i] * ux + f[1, i] * uy
    cx, cy = out[2 * centre], out[2 * centre + 1]
    for i in range(n):
        out[2 * i] -= cx
        out[2 * i + 1] -= cy
    out[2 * centre], out[2 * centre + 1], out[2 * n] = cx, cy, power
    return out


@kernel(fastmath=FAST)
def jacobian(y: State, modulus: float) -> Matrix:
    """``∂(dy/dt)/∂y`` (2N + 1, 2N + 1) of the study's scene."""
    n = (y.size - 1) // 2
    x = np.empty((2, n))
    f = np.empty((2, n))
    _positions_and_weight(y, x, f)
    _add_elastic_force(x, modulus, f)
    # One kernel: a row of mobilities and its derivative is used while it is in registers and cache; cut into functions,
    # it would be written out and read again.
    band = _elastic_band(x, modulus)
    out = np.zeros((y.size, y.size))
    m = np.zeros((3, n + 4))
    g = np.empty((4, n))
    u = np.empty((2, n))
    work = np.zeros((2, n))
    for i in range(n):
        sxx = sxy = syx = syy = 0.0
        for j in range(n):
            rx = x[0, i] - x[0, j]
            ry = x[1, i] - x[1, j]
            fx = f[0, j]
            fy = f[1, j]
            r2 = rx * rx + ry * ry
            q2 = 1.0 / (r2 if r2 > 0.0 else 1.0)
            q = q2**0.5
            a = 0.75 * q
            b = 0.5 * q * q2
            e2 = (a - 3.0 * b) * q2
            d1 = -(a + 3.0 * b) * q2
            s = rx * fx + ry * fy
            t = (15.0 * b - 3.0 * a) * q2 * q2 * s
            m[0, j + 2] = a + b + e2 * rx * rx
            m[1, j + 2] = e2 * rx * ry
            m[2, j + 2] = a + b + e2 * ry * ry
            gxx = d1 * fx * rx + t * rx * rx + e2 * (rx * fx + s)
            gxy = d1 * fx * ry + t * rx * ry + e2 * rx * fy
            gyx = d1 * fy * rx + t * rx * ry + e2 * ry * fx
            gyy = d1 * fy * ry + t * ry * ry + e2 * (ry * fy + s)
            g[0, j], g[1, j], g[2, j], g[3, j] = -gxx, -gxy, -gyx, -gyy
            sxx += gxx
            sxy += gxy
            syx += gyx
            syy += gyy
        g[0, i], g[1, i], g[2, i], g[3, i] = g[0, i] + sxx, g[1, i] + sxy, g[2, i] + syx, g[3, i] + syy
        m[0, i + 2], m[2, i + 2] = 1.0, 1.0
        for o in range(5):
            for j in range(n):
                mxx = m[0, j + o]
                mxy = m[1, j + o]
                myy = m[2, j + o]
                g[0, j] += mxx * band[o, 0, j] + mxy * band[o, 2, j]
                g[1, j] += mxx * band[o, 1, j] + mxy * band[o, 3, j]
                g[2, j] += mxy * band[o, 0, j] + myy * band[o, 2, j]
                g[3, j] += mxy * band[o, 1, j] + myy * band[o, 3, j]
        for j in range(n):
            out[2 * i, 2 * j] = g[0, j]
            out[2 * i, 2 * j + 1] = g[1, j]
            out[2 * i + 1, 2 * j] = g[2, j]
            out[2 * i + 1, 2 * j + 1] = g[3, j]
        fx = f[0, i]
        fy = f[1, i]
        ux = uy = 0.0
        for j in range(n):
            work[0, j] += fx * g[0, j] + fy * g[2, j]
            work[1, j] += fx * g[1, j] + fy * g[3, j]
            ux += m[0, j + 2] * f[0, j] + m[1, j + 2] * f[1, j]
            uy += m[1, j + 2] * f[0, j] + m[2, j + 2] * f[1, j]
        u[0, i] = ux
        u[1, i] = uy
    for o in range(5):
        for j in range(max(0, 2 - o), min(n, n + 2 - o)):
            work[0, j] += u[0, j + o - 2] * band[o, 0, j] + u[1, j + o - 2] * band[o, 2, j]
            work[1, j] += u[0, j + o - 2] * band[o, 1, j] + u[1, j + o - 2] * band[o, 3, j]
    for j in range(n):
        out[2 * n, 2 * j], out[2 * n, 2 * j + 1] = work[0, j], work[1, j]
    _to_centre_frame(out, n)
    return out


@kernel(inline="always")
def _positions_and_weight(y, x, f):
    n = x.shape[1]
    for i in range(n):
        x[0, i], x[1, i], f[0, i], f[1, i] = y[2 * i], y[2 * i + 1], 0.0, -1.0
    x[0, n // 2], x[1, n // 2] = 0.0, 0.0


@kernel(inline="always")
def _add_elastic_force(x, modulus, f):
    """Springs and bending; the unit vector of one bond is kept for the next."""
    tx = ty = length = 0.0
    for j in range(x.shape[1] - 1):
        bx = x[0, j + 1] - x[0, j]
        by = x[1, j + 1] - x[1, j]
        r = (bx * bx + by * by) ** 0.5
        px = bx / r
        py = by / r
        tension = modulus * (0.5 * r - 1.0)
        f[0, j] += tension * px
        f[1, j] += tension * py
        f[0, j + 1] -= tension * px
        f[1, j + 1] -= tension * py
        if j > 0:
            c = tx * px + ty * py
            g1x = 0.125 * modulus * (px - c * tx) / length
            g1y = 0.125 * modulus * (py - c * ty) / length
            g2x = 0.125 * modulus * (tx - c * px) / r
            g2y = 0.125 * modulus * (ty - c * py) / r
            f[0, j - 1] -= g1x
            f[1, j - 1] -= g1y
            f[0, j] += g1x - g2x
            f[1, j] += g1y - g2y
            f[0, j + 1] += g2x
            f[1, j + 1] += g2y
        tx, ty, length = px, py, r


@kernel()
def _elastic_band(x, modulus):
    """``∂F/∂x`` of springs and bending, [offset, xx/xy/yx/yy, bead], shape (5, 4, N)."""
    n = x.shape[1]
    band = np.zeros((5, 4, n))
    t = np.empty((2, n))
    length = np.empty(n)
    for j in range(n - 1):
        bx = x[0, j + 1] - x[0, j]
        by = x[1, j + 1] - x[1, j]
        r = (bx * bx + by * by) ** 0.5
        length[j], t[0, j], t[1, j] = r, bx / r, by / r
        across = modulus * (0.5 * r - 1.0) / r
        along = 0.5 * modulus - across
        for k in range(2):
            for w in range(2):
                h = along * t[k, j] * t[w, j] + (across if k == w else 0.0)
                e = 2 * k + w
                band[2, e, j] -= h
                band[2, e, j + 1] -= h
                band[3, e, j] += h
                band[1, e, j + 1] += h
    kappa = 0.125 * modulus
    for j in range(1, n - 1):
        l1 = length[j - 1]
        l2 = length[j]
        c = t[0, j - 1] * t[0, j] + t[1, j - 1] * t[1, j]
        for k in range(2):
            for w in range(2):
                pk, pw, qk, qw = t[k, j - 1], t[w, j - 1], t[k, j], t[w, j]
                unit = 1.0 if k == w else 0.0
                h11 = -kappa * ((qk - c * pk) * pw + pk * (qw - c * pw) + c * (unit - pk * pw)) / (l1 * l1)
                h22 = -kappa * ((pk - c * qk) * qw + qk * (pw - c * qw) + c * (unit - qk * qw)) / (l2 * l2)
                h12 = kappa * (unit - qk * qw - pk * (pw - c * qw)) / (l1 * l2)
                h21 = kappa * (unit - pk * pw - qk * (qw - c * pw)) / (l1 * l2)
                e = 2 * k + w
                band[2, e, j - 1] += h11
                band[1, e, j] += h12 - h11
                band[0, e, j + 1] -= h12
                band[3, e, j - 1] += h21 - h11
                band[2, e, j] += h11 - h12 - h21 + h22
                band[1, e, j + 1] += h12 - h22
                band[4, e, j - 1] -= h21
                band[3, e, j] += h21 - h22
                band[2, e, j + 1] += h22
    return band


@kernel()
def _to_centre_frame(out, n):
    c = 2 * (n // 2)
    for r in range(2 * n + 1):
        out[r, c], out[r, c + 1] = 0.0, 0.0
    for i in range(n):
        if 2 * i != c:
            for k in range(2 * n):
                out[2 * i, k] -= out[c, k]
                out[2 * i + 1, k] -= out[c + 1, k]
