"""The correction of the Rotne–Prager mobility by a plane no-slip wall, for beads of radius 1.

``ΔM_ij`` is Blake's (1971) image of the Oseen tensor, averaged over the surfaces of both
beads, which the Faxén operators ``(1 + ∇²_i/6)(1 + ∇²_j/6)`` do exactly (the UF coupling
of Swan & Brady, Phys. Fluids 19, 113306, 2007).  The image is regular in the fluid, so
overlapping beads and ``i = j`` need no form of their own; and free RPY mobility with its
overlap form plus ``ΔM`` is positive definite while every height is at least 1.

In a frame whose third axis ``n`` points from the wall into the fluid let beads ``i``, ``j``
have heights ``zi``, ``zj`` and horizontal separation ``ρ = ρ_i − ρ_j``, and let
``R = ρ + Z n``, ``Z = zi + zj``, reach from the image of ``j`` to ``i``.  With ``q = 1/R``,
``s = (Z/R)²`` and ``w = 3 zi zj/2``, in units 1/(6πμa),

    ΔM_ij = A (I − n n) + B ρ ρ + C n n + (g + f) ρ n + (g − f) n ρ

    A = −3q/4 − q³ (1/2 + w − 3s/2) + q⁵ (1 − 5s)/2
    B = −3q³/4 + q⁵ (3/2 + 3w − 15s/2) − 5q⁷ (1 − 7s)/2
    C = −3q (1 + s)/4 + q³ (w (1 − 3s) − 1/2 − 3s + 15s²/2) + q⁵ (−3/2 + 15s − 35s²/2)
    g = 3q³ (zj − zi)/4
    f = Z q⁵ (15s/2 − 3/2 − 3w + q² (15 − 35s)/2)

For ``i = j`` this is ``−9/(16h) + 1/(8h³) − 1/(16h⁵)`` along the wall and
``−9/(8h) + 1/(2h³) − 1/(8h⁵)`` across it.  A far-field form: a bead that touches the wall
keeps 1/2 and 1/4 of its mobility, because lubrication is left out.

Derivatives are complex steps, ``∂f = Im f(x + iε)/ε`` with ``ε = 2⁻¹⁰⁰``.  Nothing is
subtracted and the error is of order ε², so they are exact to round-off; and the five
scalars above stay the only formulas that have to be right.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sedfiber.core.array_types import Array, Matrix, Positions
from sedfiber.physics.kernel import kernel

STEP = 2.0**-100  # a power of two divides without rounding


@dataclass(frozen=True)
class WallCorrection:
    """The wall through ``point`` with unit ``normal`` into the fluid; beads have three coordinates."""

    point: tuple[float, float, float]
    normal: tuple[float, float, float]

    def heights(self, x: Positions) -> Array:
        """Distances of the bead centres from the wall, shape (N,), positive in the fluid."""
        return (x - np.array(self.point)) @ np.array(self.normal)

    def add_velocity(self, x: Positions, force: Positions, u: Positions) -> None:
        """Add ``ΔM(x) F`` to ``u``, shape (N, 3)."""
        in_frame = np.zeros(x.shape)
        _add_velocity(self._positions(x), force @ self._axes, in_frame)
        u += in_frame @ self._axes.T

    def add_matrix(self, x: Positions, m: Matrix) -> None:
        """Add ``ΔM(x)`` to ``m``, shape (3N, 3N)."""
        in_frame = np.empty((x.size, x.size))
        _fill_matrix(self._positions(x), in_frame)
        m += self._turn_back(in_frame)

    def add_gradient(self, x: Positions, force: Positions, jac: Matrix) -> None:
        """Add ``∂(ΔM(x) F)/∂x`` at fixed force to the first 3N rows and columns of ``jac``."""
        in_frame = np.zeros((x.size, x.size))
        _add_gradient(self._positions(x), force @ self._axes, in_frame)
        jac[: x.size, : x.size] += self._turn_back(in_frame)

    @cached_property
    def _axes(self) -> Array:
        """Axes of the wall's frame as columns (3, 3), the last one the normal.

        A Householder reflection that exchanges ±ẑ and the normal; with the sign of the
        normal's z it never cancels, for no normal.  It may mirror the two axes along the
        wall, which the mobility does not notice.
        """
        sign = np.copysign(1.0, self.normal[2])
        v = np.array(self.normal) + np.array([0.0, 0.0, sign])
        return -sign * (np.eye(3) - 2.0 * np.outer(v, v) / (v @ v))

    def _positions(self, x: Positions) -> Positions:
        """Positions in the wall's frame: the last column holds the heights."""
        return (x - np.array(self.point)) @ self._axes

    def _turn_back(self, m: Matrix) -> Matrix:
        """Blocks from the wall's frame to the one of the beads, ``Q M_ij Qᵀ`` with axes ``Q``."""
        rows = self._axes @ m.reshape(-1, 3, len(m))
        return (rows.reshape(-1, 3) @ self._axes.T).reshape(m.shape)


@kernel()
def coefficients(rho2, zi, zj):
    """``A, B, C, g, f`` for a squared horizontal distance and two heights, real or complex."""
    z = zi + zj
    q2 = 1.0 / (rho2 + z * z)
    q = np.sqrt(q2)
    q3 = q2 * q
    q5 = q3 * q2
    s = z * z * q2
    w = 1.5 * zi * zj
    a = -0.75 * q - q3 * (0.5 + w - 1.5 * s) + q5 * (0.5 - 2.5 * s)
    b = -0.75 * q3 + q5 * (1.5 + 3.0 * w - 7.5 * s) - q5 * q2 * (2.5 - 17.5 * s)
    c = -0.75 * q * (1.0 + s) + q3 * (w * (1.0 - 3.0 * s) - 0.5 - s * (3.0 - 7.5 * s))
    c += q5 * (s * (15.0 - 17.5 * s) - 1.5)
    g = 0.75 * q3 * (zj - zi)
    f = z * q5 * (7.5 * s - 1.5 - 3.0 * w + q2 * (7.5 - 17.5 * s))
    return a, b, c, g, f


@kernel()
def _fill_block(rx, ry, zi, zj, block):
    """Write ``ΔM_ij``, shape (3, 3), real or complex."""
    a, b, c, g, f = coefficients(rx * rx + ry * ry, zi, zj)
    block[0, 0] = a + b * rx * rx
    block[1, 1] = a + b * ry * ry
    block[0, 1] = block[1, 0] = b * rx * ry
    block[0, 2] = (g + f) * rx
    block[1, 2] = (g + f) * ry
    block[2, 0] = (g - f) * rx
    block[2, 1] = (g - f) * ry
    block[2, 2] = c


@kernel()
def _add_velocity(x, force, u):
    block = np.empty((3, 3))
    for i in range(x.shape[0]):
        for j in range(i + 1):
            _fill_block(x[i, 0] - x[j, 0], x[i, 1] - x[j, 1], x[i, 2], x[j, 2], block)
            for k in range(3):
                for w in range(3):
                    u[i, k] += block[k, w] * force[j, w]
                    if i != j:
                        u[j, w] += block[k, w] * force[i, k]  # ΔM_ji = ΔM_ijᵀ


@kernel()
def _fill_matrix(x, m):
    block = np.empty((3, 3))
    for i in range(x.shape[0]):
        for j in range(i + 1):
            _fill_block(x[i, 0] - x[j, 0], x[i, 1] - x[j, 1], x[i, 2], x[j, 2], block)
            for k in range(3):
                for w in range(3):
                    m[3 * i + k, 3 * j + w] = block[k, w]
                    m[3 * j + w, 3 * i + k] = block[k, w]


@kernel()
def _add_gradient(x, force, jac):
    at = np.empty(4, np.complex128)
    block = np.empty((3, 3), np.complex128)
    on_i, on_j = np.empty(3), np.empty(3)
    for i in range(x.shape[0]):
        for j in range(i + 1):
            # a bead keeps its distance from itself: only its height counts
            for c in range(2 if i == j else 0, 4):
                at[0], at[1], at[2], at[3] = x[i, 0] - x[j, 0], x[i, 1] - x[j, 1], x[i, 2], x[j, 2]
                at[c] += 1j * STEP
                _fill_block(at[0], at[1], at[2], at[3], block)
                _velocities(block, force[i], force[j], on_i, on_j)
                # arguments 0 and 1 grow with bead i and shrink with j; 2 belongs to i, 3 to j
                if c != 3:
                    _add_column(jac, i, j, 3 * i + c, 1.0, on_i, on_j)
                if c != 2:
                    _add_column(jac, i, j, 3 * j + min(c, 2), -1.0 if c < 2 else 1.0, on_i, on_j)


@kernel()
def _velocities(block, force_i, force_j, on_i, on_j):
    """Derivatives of the velocity of ``i`` from the force on ``j``, and the other way round."""
    for k in range(3):
        on_i[k] = on_j[k] = 0.0
        for w in range(3):
            on_i[k] += block[k, w].imag / STEP * force_j[w]
            on_j[k] += block[w, k].imag / STEP * force_i[w]


@kernel()
def _add_column(jac, i, j, column, sign, on_i, on_j):
    for k in range(3):
        jac[3 * i + k, column] += sign * on_i[k]
        if i != j:
            jac[3 * j + k, column] += sign * on_j[k]
