"""Bending of a fiber that is curved at rest: ``U = (ℰ/8) Σ_angles (1 − cos(θ − α))``."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sedfiber.core.array_types import Band, Positions
from sedfiber.physics.bending import spread_on_beads
from sedfiber.physics.kernel import kernel
from sedfiber.physics.protocols import TO_THE_LAST

# No bend is resolved below this sine: bond directions are rounded to 1e-16, so what is left of
# the direction of a smaller bend has fewer than four digits, and at none at all there is none.
STRAIGHT = 1e-12


@dataclass(frozen=True)
class CurvedBending:
    """Discrete worm-like chain with a rest angle ``α = 2κ₀`` between bonds, ``curvature`` κ₀ in 1/a.

    In the plane θ is signed, counterclockwise positive along the beads, and U is smooth
    everywhere.  In volume θ is in [0, π] and α stands for |α|: the fiber resists no twist, so it
    may bend any way at each bead.  All shapes with bond angles α are then at rest, an arc, a helix
    or a zigzag; and a straight fiber, θ = 0, has no direction to bend to: a ridge of U, where
    the force is given as zero.  No fiber should start there.

    Let bonds have lengths ``l1, l2``, directions ``t1, t2``, normals ``n1, n2`` towards the
    bend (in the plane: turned by +90°), ``c = t1·t2 = cos θ``, ``s = sin θ`` and ``φ = θ − α``.
    Then ``g1 = ∂cos φ/∂b1 = sin φ n1/l1`` and ``g2 = ∂cos φ/∂b2 = −sin φ n2/l2``, and the three
    beads feel ``(ℰ/8)(−g1, g1 − g2, g2)``.  With α = 0 this is ``Bending``, whose modulus, source
    and range of beads, from ``first`` to before ``last``, these are.
    """

    modulus: float
    curvature: float
    first: int = 0
    last: int = TO_THE_LAST

    needs_lab_frame: ClassVar[bool] = False
    banded: ClassVar[bool] = True

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the bending forces to ``force``, shape (N, d)."""
        _add_force(x, self.modulus / 8.0, 2.0 * self.curvature, self.first, self.last, force)

    def add_jacobian(self, x: Positions, jac: Band) -> None:
        """Add ``∂F/∂x`` to the band ``jac``, shape (5, d, d, N)."""
        _add_jacobian(x, self.modulus / 8.0, 2.0 * self.curvature, self.first, self.last, jac)

    def energy(self, x: Positions) -> float:
        """``(ℰ/8) Σ (1 − cos(θ − α))`` in units of ``6πμaU_s · a``."""
        return _energy(x, self.modulus / 8.0, 2.0 * self.curvature, self.first, self.last)


def rest_arc(n_beads: int, curvature: float, dim: int) -> Positions:
    """A fiber at rest (N, d): bonds of length 2 that turn by 2κ₀ each, chord along x, centre bead at 0.

    Its beads lie on a circle of curvature ``sin κ₀``; it opens upwards, to +y, for κ₀ > 0.
    """
    heading = 2.0 * curvature * (np.arange(n_beads - 1) - (n_beads - 2) / 2)
    x = np.zeros((n_beads, dim))
    x[1:, 0] = np.cumsum(2.0 * np.cos(heading))
    x[1:, 1] = np.cumsum(2.0 * np.sin(heading))
    return x - x[n_beads // 2]


@kernel()
def _corner(x, m, cos_rest, sin_rest, t, n, g):
    """Directions, normals and ``sin φ`` times these (2, d) of the bonds before and after bead ``m``.

    Returns both lengths, ``cos θ``, ``sin θ`` and the ratio ``sin φ / sin θ``: 0 in the plane, where
    it may be infinite and nothing asks for it.
    """
    d = x.shape[1]
    l1 = l2 = c = 0.0
    for k in range(d):
        t[0, k] = x[m, k] - x[m - 1, k]
        t[1, k] = x[m + 1, k] - x[m, k]
        l1 += t[0, k] * t[0, k]
        l2 += t[1, k] * t[1, k]
    l1, l2 = np.sqrt(l1), np.sqrt(l2)
    for k in range(d):
        t[0, k] /= l1
        t[1, k] /= l2
        c += t[0, k] * t[1, k]
    if d == 2:
        s = t[0, 0] * t[1, 1] - t[0, 1] * t[1, 0]
        for b in range(2):
            n[b, 0], n[b, 1] = -t[b, 1], t[b, 0]
            for k in range(d):
                g[b, k] = (s * cos_rest - c * sin_rest) * n[b, k]
        return l1, l2, c, s, 0.0
    s = 0.0
    for k in range(d):
        g[0, k] = t[1, k] - c * t[0, k]  # sin θ times the normal
        s += g[0, k] * g[0, k]
    s = np.sqrt(s)
    over = 1.0 / max(s, STRAIGHT)
    ratio = cos_rest - c * sin_rest * over
    for k in range(d):
        n[0, k] = over * g[0, k]
        n[1, k] = c * n[0, k] - s * t[0, k]
        g[0, k] *= ratio
        g[1, k] = ratio * (c * t[1, k] - t[0, k])
    return l1, l2, c, s, ratio


@kernel()
def _rest(angle, d):
    angle = abs(angle) if d == 3 else angle
    return np.cos(angle), np.sin(angle)


@kernel()
def _energy(x, kappa, angle, first, last):
    d = x.shape[1]
    t, n, g = np.empty((2, d)), np.empty((2, d)), np.empty((2, d))
    cos_rest, sin_rest = _rest(angle, d)
    total = 0.0
    for m in range(first + 1, min(last, x.shape[0]) - 1):
        _, _, c, s, _ = _corner(x, m, cos_rest, sin_rest, t, n, g)
        # 1 − cos φ as half the squared distance of two points on the unit circle keeps its digits
        total += 0.5 * ((c - cos_rest) ** 2 + (s - sin_rest) ** 2)
    return kappa * total


@kernel()
def _add_force(x, kappa, angle, first, last, force):
    d = x.shape[1]
    t, n, g = np.empty((2, d)), np.empty((2, d)), np.empty((2, d))
    cos_rest, sin_rest = _rest(angle, d)
    for m in range(first + 1, min(last, x.shape[0]) - 1):
        l1, l2, _, _, _ = _corner(x, m, cos_rest, sin_rest, t, n, g)
        for k in range(d):
            g1, g2 = kappa / l1 * g[0, k], -kappa / l2 * g[1, k]
            force[m - 1, k] -= g1
            force[m, k] += g1 - g2
            force[m + 1, k] += g2


@kernel()
def _add_jacobian(x, kappa, angle, first, last, band):
    d = x.shape[1]
    t, n, g = np.empty((2, d)), np.empty((2, d)), np.empty((2, d))
    cos_rest, sin_rest = _rest(angle, d)
    for m in range(first + 1, min(last, x.shape[0]) - 1):
        l1, l2, c, s, ratio = _corner(x, m, cos_rest, sin_rest, t, n, g)
        cos_bend = c * cos_rest + s * sin_rest
        for k in range(d):
            for w in range(d):
                # along the bend, and across its plane, which is nowhere in the plane
                across = ratio * ((1.0 if k == w else 0.0) - t[0, k] * t[0, w] - n[0, k] * n[0, w])
                a1 = cos_bend * n[0, k] * n[0, w] + c * across + g[0, k] * t[0, w] + t[0, k] * g[0, w]
                a2 = cos_bend * n[1, k] * n[1, w] + c * across - g[1, k] * t[1, w] - t[1, k] * g[1, w]
                h11, h22 = -kappa / (l1 * l1) * a1, -kappa / (l2 * l2) * a2
                h12 = kappa / (l1 * l2) * (cos_bend * n[0, k] * n[1, w] + across)
                h21 = kappa / (l1 * l2) * (cos_bend * n[1, k] * n[0, w] + across)
                spread_on_beads(h11, h12, h21, h22, m, k, w, band)
