"""The couple that a flow exerts on beads which turn with their fiber instead of freely.

A sphere held at angular velocity Ω where the fluid turns at ω∞, half its vorticity, feels the
couple ``8πμa³ (ω∞ − Ω)``, that is ``(4/3)(ω∞ − Ω)`` in the unit ``6πμa²U_s``.  A fiber of
direction ``t`` carried along by a flow of gradient ``G`` turns at ``Ω = t × (G t)``, and then

    (ω∞ − Ω) × t = −(E t − t (t·E t)),    E = (G + Gᵀ)/2

A couple ``K`` normal to a bond ``b = |b| t`` is a pair of forces ±f on the bond's two beads with
``b × f = K``, that is ``f = K × t/|b|``; so a bond that carries the couple of one bead puts

    f = −(4/3) (E t − t (t·E t))/|b|

on the bead ahead and ``−f`` on the one behind.  Each bead shares its couple half and half between
its two bonds, and an end bead leaves it to its one bond: a bond weighs 1 inside a fiber, 3/2
at an end, and 2 if it is the only one.  Single beads have no bonds: they turn freely.

Without these couples a straight fiber along a shear never turns; with them it tumbles as
Jeffery's (1922) spheroid of a finite aspect ratio r_e does, in periods about proportional to r_e.
The flow that beads make by these couples is in ``couple_flow`` and belongs to them: a rigid chain of 11
(31) beads has r_e = 9.01 (23.05) with it and 6.04 (14.30) without.  Rotne–Prager multipoles give 8.64
(21.86) to the torque and 9.09 (23.08) to the stresslet, and slender-body theory (Cox 1971) 8.81 (20.74) for
a blunt cylinder of the same aspect ratio.  Short chains are rougher: 1 % below the stresslets at 11
beads, 3 % at 5, a quarter at 2.  Left out: spin about ``t``; that Ω differs from ``t × (G t)``, which
would add 2 to the r_e² of a rigid chain; and what the beads' own flows add to ω∞ and to ``G``.
"""

from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from sedfiber.core.array_types import Array, Band, Positions
from sedfiber.physics.kernel import kernel

COUPLE = 4.0 / 3.0  # on a sphere held in fluid that turns at unit rate: 8πμa³ in 6πμa²U_s


class StrainingFlow(Protocol):
    """A flow whose rate of strain varies with y at most, and in its xy entries only.

    ``strain`` is ``(E0, s)``: ``E0`` (3, 3) the rate of strain at y = 0, to which ``E_xy = E_yx`` add ``s y``.
    """

    @property
    def strain(self) -> tuple[Array, float]: ...


@dataclass(frozen=True)
class FlowCouple:
    """Pairs of forces that turn the bonds of fibers of ``fiber_beads`` beads, numbered one after another.

    ``E`` is taken at the middle of a bond.  With ``p = E t`` and ``q = t·p`` the derivative of
    ``(p − q t)/|b|`` is ``(E − 2 p t − 2 t p − q I + 4 q t t)/|b|²`` by the bond ``b``, and
    by the middle's y the same expression ``(p − q t)/|b|`` with ``s (x̂ŷ + ŷx̂)`` for ``E``.
    """

    flow: StrainingFlow
    fiber_beads: int

    needs_lab_frame: ClassVar[bool] = True
    banded: ClassVar[bool] = True

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the pairs of forces, in ``6πμaU_s``, to ``force``, shape (N, d)."""
        strain, slope = self.flow.strain
        _add_force(x, strain, slope, self.fiber_beads, force)

    def add_jacobian(self, x: Positions, jac: Band) -> None:
        """Add ``∂F/∂x`` to the band ``jac``, shape (5, d, d, N)."""
        strain, slope = self.flow.strain
        _add_jacobian(x, strain, slope, self.fiber_beads, jac)


@kernel()
def bonded(j, beads):
    """Whether bead ``j`` and the next one belong to the same fiber of ``beads``."""
    return j % beads != beads - 1


@kernel()
def share(j, beads):
    """The share of the couple of bead ``j`` on each of its bonds: half, or all at an end of its fiber."""
    return 1.0 if j % beads == 0 or not bonded(j, beads) else 0.5


@kernel()
def direction(x, j, t):
    """Unit vector ``t`` of the bond from bead ``j``; returns its length."""
    r2 = 0.0
    for k in range(x.shape[1]):
        t[k] = x[j + 1, k] - x[j, k]
        r2 += t[k] * t[k]
    r = np.sqrt(r2)
    for k in range(x.shape[1]):
        t[k] /= r
    return r


@kernel()
def strained(strain, sy, t, p):
    """``p = E t`` where ``E_xy`` is larger by ``sy`` than in ``strain``; returns ``t·p``."""
    q = 0.0
    for k in range(t.size):
        p[k] = 0.0
        for w in range(t.size):
            p[k] += strain[k, w] * t[w]
    p[0] += sy * t[1]
    p[1] += sy * t[0]
    for k in range(t.size):
        q += t[k] * p[k]
    return q


@kernel()
def _add_force(x, strain, slope, beads, force):
    n, d = x.shape
    t, p = np.empty(d), np.empty(d)
    for j in range(n - 1):
        if not bonded(j, beads):
            continue
        strength = -COUPLE * (share(j, beads) + share(j + 1, beads))
        r = direction(x, j, t)
        q = strained(strain, 0.5 * slope * (x[j, 1] + x[j + 1, 1]), t, p)
        for k in range(d):
            f = strength * (p[k] - q * t[k]) / r
            force[j + 1, k] += f
            force[j, k] -= f


@kernel()
def _add_jacobian(x, strain, slope, beads, band):
    n, d = x.shape
    t, p, unit_p = np.empty(d), np.empty(d), np.empty(d)
    none = np.zeros((d, d))
    for j in range(n - 1):
        if not bonded(j, beads):
            continue
        strength = -COUPLE * (share(j, beads) + share(j + 1, beads))
        r = direction(x, j, t)
        sy = 0.5 * slope * (x[j, 1] + x[j + 1, 1])
        q = strained(strain, sy, t, p)
        unit_q = strained(none, slope, t, unit_p)
        for k in range(d):
            for w in range(d):
                e = strain[k, w] + (sy if k + w == 1 else 0.0) - (q if k == w else 0.0)
                h = strength * (e - 2.0 * (p[k] * t[w] + t[k] * p[w]) + 4.0 * q * t[k] * t[w]) / (r * r)
                # each end of the bond moves its middle by half as much
                m = 0.5 * strength * (unit_p[k] - unit_q * t[k]) / r if w == 1 else 0.0
                band[2, k, w, j + 1] += h + m
                band[3, k, w, j] += m - h
                band[1, k, w, j + 1] -= h + m
                band[2, k, w, j] += h - m
