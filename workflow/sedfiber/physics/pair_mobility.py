"""Compiled sums over bead pairs for mobilities of the form ``M = 1``, ``c1 I + c2 r̂ r̂``.

For beads ``i ≠ j`` with ``r = x_i − x_j``, ``r = |r|`` the mobility block is

    M_ij = c1(r) I + c2(r) r̂ r̂ᵀ            (units 1/(6πμa)),      M_ii = I.

Rotne–Prager–Yamakawa, for spheres of radius 1 (Rotne & Prager 1969; Yamakawa 1970):

    r ≥ 2:  c1 = 3/(4r) + 1/(2r³),  c2 = 3/(4r) − 3/(2r³)
    r < 2:  c1 = 1 − 9r/32,         c2 = 3r/32               (only with ``overlap``)

The same loops serve plane and volume: ``d = x.shape[1]`` is 2 or 3, and a
missing third coordinate is a zero that is never stored.
"""

import numpy as np
from numba import njit

from sedfiber._typing import Matrix, Positions


@njit(cache=True, inline="always")
def coefficients(r, overlap):
    """``c1``, ``c2`` and their derivatives with respect to ``r`` at one distance."""
    if overlap and r < 2.0:
        return 1.0 - 9.0 * r / 32.0, 3.0 * r / 32.0, -9.0 / 32.0, 3.0 / 32.0
    q = 1.0 / r
    a = 0.75 * q
    b = 0.5 * q * q * q
    return a + b, a - 3.0 * b, -q * (a + 3.0 * b), q * (-a + 9.0 * b)


@njit(cache=True)
def add_pair_velocities(x: Positions, force: Positions, overlap: bool, u: Positions) -> None:
    """Add ``Σ_j M_ij F_j`` to ``u``, shape (N, d)."""
    n, d = x.shape
    spatial = d == 3
    for i in range(n):
        xi, yi, zi = x[i, 0], x[i, 1], x[i, 2] if spatial else 0.0
        fx, fy, fz = force[i, 0], force[i, 1], force[i, 2] if spatial else 0.0
        ux, uy, uz = fx, fy, fz
        for j in range(i):
            rx, ry = xi - x[j, 0], yi - x[j, 1]
            rz = zi - x[j, 2] if spatial else 0.0
            gx, gy = force[j, 0], force[j, 1]
            gz = force[j, 2] if spatial else 0.0
            r2 = rx * rx + ry * ry + rz * rz
            c1, c2, _, _ = coefficients(np.sqrt(r2), overlap)
            c2 /= r2
            p = c2 * (rx * gx + ry * gy + rz * gz)
            q = c2 * (rx * fx + ry * fy + rz * fz)
            ux += c1 * gx + p * rx
            uy += c1 * gy + p * ry
            u[j, 0] += c1 * fx + q * rx
            u[j, 1] += c1 * fy + q * ry
            if spatial:
                uz += c1 * gz + p * rz
                u[j, 2] += c1 * fz + q * rz
        u[i, 0] += ux
        u[i, 1] += uy
        if spatial:
            u[i, 2] += uz


@njit(cache=True)
def fill_mobility(x: Positions, overlap: bool, m: Matrix) -> None:
    """Write the whole mobility matrix, shape (N d, N d)."""
    n, d = x.shape
    r = np.empty(d)
    for i in range(n):
        for k in range(d):
            for w in range(d):
                m[i * d + k, i * d + w] = 1.0 if k == w else 0.0
        for j in range(i):
            r2 = 0.0
            for k in range(d):
                r[k] = x[i, k] - x[j, k]
                r2 += r[k] * r[k]
            c1, c2, _, _ = coefficients(np.sqrt(r2), overlap)
            c2 /= r2
            for k in range(d):
                for w in range(d):
                    block = c2 * r[k] * r[w] + (c1 if k == w else 0.0)
                    m[i * d + k, j * d + w] = block
                    m[j * d + w, i * d + k] = block


@njit(cache=True)
def add_mobility_gradient(x: Positions, force: Positions, overlap: bool, jac: Matrix) -> None:
    """Add ``∂(M(x) F)/∂x`` at fixed force to ``jac``, shape (N d, N d).

    With ``s = r·F`` and ``e2 = c2/r²`` one pair contributes to the velocity
    ``c1 F + e2 s r``, whose derivative with respect to ``r`` is
    ``(c1'/r) F rᵀ + (e2'/r) s r rᵀ + e2 (s I + r Fᵀ)``.
    """
    n, d = x.shape
    r = np.empty(d)
    for i in range(n):
        for j in range(i):
            r2 = 0.0
            for k in range(d):
                r[k] = x[i, k] - x[j, k]
                r2 += r[k] * r[k]
            dist = np.sqrt(r2)
            _, c2, dc1, dc2 = coefficients(dist, overlap)
            e1 = dc1 / dist
            e2 = c2 / r2
            e3 = (dc2 - 2.0 * c2 / dist) / (r2 * dist)
            s_j = 0.0
            s_i = 0.0
            for k in range(d):
                s_j += r[k] * force[j, k]
                s_i += r[k] * force[i, k]
            for k in range(d):
                for w in range(d):
                    # velocity of i from the force on j, and of j from the force on i
                    on_i = e1 * force[j, k] * r[w] + e3 * s_j * r[k] * r[w] + e2 * r[k] * force[j, w]
                    on_j = e1 * force[i, k] * r[w] + e3 * s_i * r[k] * r[w] + e2 * r[k] * force[i, w]
                    if k == w:
                        on_i += e2 * s_j
                        on_j += e2 * s_i
                    jac[i * d + k, i * d + w] += on_i
                    jac[i * d + k, j * d + w] -= on_i
                    jac[j * d + k, i * d + w] += on_j
                    jac[j * d + k, j * d + w] -= on_j


@njit(cache=True)
def smallest_gap(x: Positions) -> float:
    """Smallest centre distance between beads that are not neighbours, less one diameter."""
    n, d = x.shape
    best = np.inf
    for i in range(n):
        for j in range(i - 1):
            r2 = 0.0
            for k in range(d):
                r2 += (x[i, k] - x[j, k]) ** 2
            best = min(best, r2)
    return np.sqrt(best) - 2.0
