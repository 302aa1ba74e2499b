"""Bending: ``U = (ℰ/8) Σ_angles (1 − cos θ)``, θ between consecutive bond vectors."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sedfiber.core.array_types import Band, Positions
from sedfiber.physics.kernel import kernel
from sedfiber.physics.protocols import TO_THE_LAST


@dataclass(frozen=True)
class Bending:
    """Discrete worm-like chain, straight at rest (DESIGN: Û, second sum).

    With bonds ``b1, b2`` of lengths ``l1, l2``, directions ``t1, t2`` and
    ``c = t1·t2``, the derivatives of ``c`` are ``g1 = (t2 − c t1)/l1`` and
    ``g2 = (t1 − c t2)/l2``, and the three beads feel ``(ℰ/8)(−g1, g1 − g2, g2)``.
    Source: Schlagberger & Netz 2005, with the bending modulus ``Eπa⁴/4``.  The fiber is made
    of the beads from ``first`` to before ``last``.
    """

    modulus: float
    first: int = 0
    last: int = TO_THE_LAST

    needs_lab_frame: ClassVar[bool] = False
    banded: ClassVar[bool] = True

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the bending forces to ``force``, shape (N, d)."""
        _add_force(x, self.modulus / 8.0, self.first, self.last, force)

    def add_jacobian(self, x: Positions, jac: Band) -> None:
        """Add ``∂F/∂x`` to the band ``jac``, shape (5, d, d, N)."""
        _add_jacobian(x, self.modulus / 8.0, self.first, self.last, jac)

    def energy(self, x: Positions) -> float:
        """``(ℰ/8) Σ (1 − cos θ)`` in units of ``6πμaU_s · a``."""
        return _energy(x, self.modulus / 8.0, self.first, self.last)


@kernel()
def _directions(x, m, t1, t2):
    """Unit bond vectors before and after bead ``m``; returns both lengths and the cosine."""
    l1 = 0.0
    l2 = 0.0
    for k in range(x.shape[1]):
        t1[k] = x[m, k] - x[m - 1, k]
        t2[k] = x[m + 1, k] - x[m, k]
        l1 += t1[k] * t1[k]
        l2 += t2[k] * t2[k]
    l1, l2 = np.sqrt(l1), np.sqrt(l2)
    c = 0.0
    for k in range(x.shape[1]):
        t1[k] /= l1
        t2[k] /= l2
        c += t1[k] * t2[k]
    return l1, l2, c


@kernel()
def _energy(x, kappa, first, last):
    t1, t2 = np.empty(x.shape[1]), np.empty(x.shape[1])
    total = 0.0
    for m in range(first + 1, min(last, x.shape[0]) - 1):
        _directions(x, m, t1, t2)
        # 1 − cos θ = |t2 − t1|²/2 keeps its digits for a nearly straight fiber
        for k in range(x.shape[1]):
            total += 0.5 * (t2[k] - t1[k]) ** 2
    return kappa * total


@kernel()
def _add_force(x, kappa, first, last, force):
    spatial = x.shape[1] == 3
    end = min(last, x.shape[0]) - 1
    ax = ay = az = p = 0.0  # the bond before: its direction, and κ over its length
    mx = my = mz = nx = ny = nz = 0.0  # so far, the forces on bead m − 1 and on bead m
    for m in range(first, end):
        bx = x[m + 1, 0] - x[m, 0]
        by = x[m + 1, 1] - x[m, 1]
        bz = x[m + 1, 2] - x[m, 2] if spatial else 0.0
        over = 1.0 / np.sqrt(bx * bx + by * by + bz * bz)
        bx, by, bz, q = bx * over, by * over, bz * over, kappa * over
        if m > first:
            c = ax * bx + ay * by + az * bz
            gx, hx = p * (bx - c * ax), q * (ax - c * bx)
            gy, hy = p * (by - c * ay), q * (ay - c * by)
            force[m - 1, 0] += mx - gx
            force[m - 1, 1] += my - gy
            mx, my, nx, ny = nx + gx - hx, ny + gy - hy, hx, hy
            if spatial:
                gz, hz = p * (bz - c * az), q * (az - c * bz)
                force[m - 1, 2] += mz - gz
                mz, nz = nz + gz - hz, hz
        ax, ay, az, p = bx, by, bz, q
    if end > first:
        force[end - 1, 0] += mx
        force[end - 1, 1] += my
        force[end, 0] += nx
        force[end, 1] += ny
        if spatial:
            force[end - 1, 2] += mz
            force[end, 2] += nz


@kernel()
def _add_jacobian(x, kappa, first, last, band):
    d = x.shape[1]
    t1, t2 = np.empty(d), np.empty(d)
    for m in range(first + 1, min(last, x.shape[0]) - 1):
        l1, l2, c = _directions(x, m, t1, t2)
        for k in range(d):
            for w in range(d):
                unit = 1.0 if k == w else 0.0
                # second derivatives of c with respect to the two bonds
                a1 = (t2[k] - c * t1[k]) * t1[w] + t1[k] * (t2[w] - c * t1[w])
                a2 = (t1[k] - c * t2[k]) * t2[w] + t2[k] * (t1[w] - c * t2[w])
                h11 = -kappa * (a1 + c * (unit - t1[k] * t1[w])) / (l1 * l1)
                h22 = -kappa * (a2 + c * (unit - t2[k] * t2[w])) / (l2 * l2)
                h12 = kappa * (unit - t2[k] * t2[w] - t1[k] * (t1[w] - c * t2[w])) / (l1 * l2)
                h21 = kappa * (unit - t1[k] * t1[w] - t2[k] * (t2[w] - c * t1[w])) / (l1 * l2)
                spread_on_beads(h11, h12, h21, h22, m, k, w, band)


@kernel()
def spread_on_beads(h11, h12, h21, h22, m, k, w, band):
    """Add entry (k, w) of second derivatives by the bonds before and after bead ``m`` to the three beads' blocks."""
    band[2, k, w, m - 1] += h11
    band[1, k, w, m] += h12 - h11
    band[0, k, w, m + 1] -= h12
    band[3, k, w, m - 1] += h21 - h11
    band[2, k, w, m] += h11 - h12 - h21 + h22
    band[1, k, w, m + 1] += h12 - h22
    band[4, k, w, m - 1] -= h21
    band[3, k, w, m] += h21 - h22
    band[2, k, w, m + 1] += h22
