"""The flow that beads make by the couples which a background flow exerts on them.

A bead on which the fluid exerts the couple ``K`` passes ``T = −K`` on to the fluid, and a sphere's
torque makes a rotlet, ``T × r/(8πμr³)`` at ``r`` from it.  Its mean over the surface of a bead is
its value at the centre while they do not overlap; for ``r < 2`` the Rotne–Prager form of the coupling
replaces it (Wajnryb, Mizerski, Zuk & Szymczak 2013).  In units of ``U_s``, ``a``, ``6πμa²U_s``:

    u_i = Σ_{j≠i} c(r) T_j × r,   r = x_i − x_j,   c = 3/(4r³),  or  3/8 − 9r/64  for r < 2

which is continuous with its slope and finite everywhere.  The couples are those of ``flow_couple``:
a bond of direction ``t`` carries ``(4/3) t × E t`` of ``T`` for a whole bead, a bead inside a fiber takes
half of that from each of its two bonds, an end bead all from its one bond, and a single bead nothing.

Pairs of forces and rotlets together leave the fluid without a torque, as a fiber free to turn must.
So this flow belongs to ``flow_couple`` wherever beads move each other (Oseen, RPY); in free draining they
do not.  Left out: the image of the rotlets in a wall, and the couples that the beads' own flows cause.
"""

from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import Matrix, Positions
from sedfiber.physics.flow_couple import COUPLE, StrainingFlow, bonded, direction, share, strained
from sedfiber.physics.kernel import kernel
from sedfiber.physics.pair_forms import FAST


@dataclass(frozen=True)
class CoupleFlow:
    """Rotlets of fibers of ``fiber_beads`` beads in ``flow``, numbered one after another; all beads feel them.

    Derivatives are analytic.  One pair has ``c [T×] + (c'/r) (T × r) rᵀ`` by ``r``; the ``T`` of one bond
    has ``(4/3) (A − 2 (t × E t) tᵀ)/|b|`` by the bond ``b``, where ``A v = v × E t + t × E v``, and by the
    middle's y the expression for ``T`` with ``s (x̂ŷ + ŷx̂)`` for ``E``.
    """

    flow: StrainingFlow
    fiber_beads: int

    def add_velocity(self, x: Positions, u: Positions) -> None:
        """Add the flow of all other beads' torques to ``u``, shape (N, d)."""
        strain, slope = self.flow.strain
        _add_velocity(x, strain, slope, self.fiber_beads, u)

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``∂u/∂x`` to ``jac``, at least (N d, N d)."""
        strain, slope = self.flow.strain
        _add_jacobian(x, strain, slope, self.fiber_beads, jac)


@kernel(inline="always")
def _coefficients(r2):
    """``c`` and ``c'/r`` at a squared distance; at zero, for the bead itself, anything finite."""
    near = r2 < 4.0
    r2 = r2 if r2 > 0.0 else 1.0
    q2 = 1.0 / r2
    q = q2**0.5
    c = 0.375 - 0.140625 * r2 * q if near else 0.75 * q * q2
    e = -0.140625 * q if near else -2.25 * q * q2 * q2
    return c, e


@kernel()
def _in_space(x, strain):
    """Positions with three coordinates and the strain that acts: in the plane only its upper left 2×2."""
    n, d = x.shape
    space, acting = np.zeros((n, 3)), np.zeros((3, 3))
    space[:, :d] = x
    acting[:d, :d] = strain[:d, :d]
    return space, acting


@kernel()
def _cross(a, b, out):
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]


@kernel()
def _torques(x, strain, slope, beads):
    """``T`` of the beads as contiguous rows, shape (3, N), from positions (N, 3)."""
    n = x.shape[0]
    rows = np.zeros((3, n))
    t, p, torque = np.empty(3), np.empty(3), np.empty(3)
    for j in range(n - 1):
        if not bonded(j, beads):
            continue
        direction(x, j, t)
        strained(strain, 0.5 * slope * (x[j, 1] + x[j + 1, 1]), t, p)
        _cross(t, p, torque)
        for k in range(3):
            rows[k, j] += COUPLE * share(j, beads) * torque[k]
            rows[k, j + 1] += COUPLE * share(j + 1, beads) * torque[k]
    return rows


@kernel(fastmath=FAST)
def _add_velocity(x, strain, slope, beads, u):
    n, d = x.shape
    space, acting = _in_space(x, strain)
    torque = _torques(space, acting, slope, beads)
    at = np.ascontiguousarray(space.T)
    for i in range(n):
        ux = uy = uz = 0.0
        for j in range(n):
            rx = at[0, i] - at[0, j]
            ry = at[1, i] - at[1, j]
            rz = at[2, i] - at[2, j]
            c, _ = _coefficients(rx * rx + ry * ry + rz * rz)
            ux += c * (torque[1, j] * rz - torque[2, j] * ry)
            uy += c * (torque[2, j] * rx - torque[0, j] * rz)
            uz += c * (torque[0, j] * ry - torque[1, j] * rx)
        u[i, 0] += ux
        u[i, 1] += uy
        if d == 3:
            u[i, 2] += uz


@kernel()
def _torque_slopes(x, strain, slope, beads):
    """``∂T_k/∂x_w`` of the bond from bead ``j``, by that bead and by the next: shape (2, w, k, N)."""
    n = x.shape[0]
    slopes = np.zeros((2, 3, 3, n))
    none, unit = np.zeros((3, 3)), np.eye(3)
    t, p, turn = np.empty(3), np.empty(3), np.empty(3)
    column, first, second = np.empty(3), np.empty(3), np.empty(3)
    for j in range(n - 1):
        if not bonded(j, beads):
            continue
        length = direction(x, j, t)
        sy = 0.5 * slope * (x[j, 1] + x[j + 1, 1])
        strained(strain, sy, t, p)
        _cross(t, p, turn)
        for w in range(3):
            _cross(unit[w], p, first)
            strained(strain, sy, unit[w], column)
            _cross(t, column, second)
            for k in range(3):
                h = COUPLE * (first[k] + second[k] - 2.0 * turn[k] * t[w]) / length
                slopes[0, w, k, j], slopes[1, w, k, j] = -h, h
        strained(none, slope, t, p)
        _cross(t, p, turn)
        for k in range(3):
            # each end of the bond moves its middle by half as much
            slopes[0, 1, k, j] += 0.5 * COUPLE * turn[k]
            slopes[1, 1, k, j] += 0.5 * COUPLE * turn[k]
    return slopes


@kernel(fastmath=FAST)
def _add_jacobian(x, strain, slope, beads, jac):
    n, d = x.shape
    space, acting = _in_space(x, strain)
    torque = _torques(space, acting, slope, beads)
    slopes = _torque_slopes(space, acting, slope, beads)
    at = np.ascontiguousarray(space.T)
    shares = np.array([share(j, beads) for j in range(n)])
    arms = np.empty((3, n))  # c r of each bead, then of each bond
    g = np.empty((9, n))  # row i of the result, as the block of bead j is read
    for i in range(n):
        _pair_row(at, torque, i, g, arms)
        for k in range(3):
            for j in range(n):
                arms[k, j] *= shares[j]
            for j in range(n - 1):
                arms[k, j] += arms[k, j + 1]
        for end in range(2):
            for w in range(d):
                turn = slopes[end, w]  # (k, N)
                for j in range(n - 1):
                    g[w, j + end] += turn[1, j] * arms[2, j] - turn[2, j] * arms[1, j]
                    g[3 + w, j + end] += turn[2, j] * arms[0, j] - turn[0, j] * arms[2, j]
                    g[6 + w, j + end] += turn[0, j] * arms[1, j] - turn[1, j] * arms[0, j]
        for j in range(n):
            for k in range(d):
                for w in range(d):
                    jac[i * d + k, j * d + w] += g[3 * k + w, j]


@kernel(fastmath=FAST)
def _pair_row(at, torque, i, g, arms):
    """Bead i with every bead: ``c r`` into ``arms`` and the derivatives at fixed torques into ``g``."""
    n = at.shape[1]
    for j in range(n):
        rx = at[0, i] - at[0, j]
        ry = at[1, i] - at[1, j]
        rz = at[2, i] - at[2, j]
        tx, ty, tz = torque[0, j], torque[1, j], torque[2, j]
        c, e = _coefficients(rx * rx + ry * ry + rz * rz)
        ux = e * (ty * rz - tz * ry)
        uy = e * (tz * rx - tx * rz)
        uz = e * (tx * ry - ty * rx)
        arms[0, j], arms[1, j], arms[2, j] = c * rx, c * ry, c * rz
        g[0, j], g[1, j], g[2, j] = -ux * rx, c * tz - ux * ry, -c * ty - ux * rz
        g[3, j], g[4, j], g[5, j] = -c * tz - uy * rx, -uy * ry, c * tx - uy * rz
        g[6, j], g[7, j], g[8, j] = c * ty - uz * rx, -c * tx - uz * ry, -uz * rz
    for k in range(9):
        g[k, i] = 0.0
        own = 0.0
        for j in range(n):
            own -= g[k, j]
        g[k, i] = own
