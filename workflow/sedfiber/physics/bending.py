"""Bending: ``U = (ℰ/8) Σ_angles (1 − cos θ)``, θ between consecutive bond vectors."""

from dataclasses import dataclass

import numpy as np
from numba import njit

from sedfiber._typing import Matrix, Positions


@dataclass(frozen=True)
class Bending:
    """Discrete worm-like chain, straight at rest (DESIGN: Û, second sum).

    With bonds ``b1, b2`` of lengths ``l1, l2``, directions ``t1, t2`` and
    ``c = t1·t2``, the derivatives of ``c`` are ``g1 = (t2 − c t1)/l1`` and
    ``g2 = (t1 − c t2)/l2``, and the three beads feel ``(ℰ/8)(−g1, g1 − g2, g2)``.
    Source: Schlagberger & Netz 2005, with the bending modulus ``Eπa⁴/4``.
    """

    modulus: float

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the bending forces to ``force``, shape (N, d)."""
        _add_force(x, self.modulus / 8.0, force)

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``∂F/∂x`` to ``jac``, shape (N d, N d)."""
        _add_jacobian(x, self.modulus / 8.0, jac)

    def energy(self, x: Positions) -> float:
        """``(ℰ/8) Σ (1 − cos θ)`` in units of ``6πμaU_s · a``."""
        return _energy(x, self.modulus / 8.0)


@njit(cache=True)
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


@njit(cache=True)
def _energy(x, kappa):
    t1, t2 = np.empty(x.shape[1]), np.empty(x.shape[1])
    total = 0.0
    for m in range(1, x.shape[0] - 1):
        _directions(x, m, t1, t2)
        # 1 − cos θ = |t2 − t1|²/2 keeps its digits for a nearly straight fiber
        for k in range(x.shape[1]):
            total += 0.5 * (t2[k] - t1[k]) ** 2
    return kappa * total


@njit(cache=True)
def _add_force(x, kappa, force):
    d = x.shape[1]
    t1, t2 = np.empty(d), np.empty(d)
    for m in range(1, x.shape[0] - 1):
        l1, l2, c = _directions(x, m, t1, t2)
        for k in range(d):
            g1 = kappa * (t2[k] - c * t1[k]) / l1
            g2 = kappa * (t1[k] - c * t2[k]) / l2
            force[m - 1, k] -= g1
            force[m, k] += g1 - g2
            force[m + 1, k] += g2


@njit(cache=True)
def _add_jacobian(x, kappa, jac):
    d = x.shape[1]
    t1, t2 = np.empty(d), np.empty(d)
    for m in range(1, x.shape[0] - 1):
        l1, l2, c = _directions(x, m, t1, t2)
        p, q, s = (m - 1) * d, m * d, (m + 1) * d
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
                jac[p + k, p + w] += h11
                jac[p + k, q + w] += h12 - h11
                jac[p + k, s + w] -= h12
                jac[q + k, p + w] += h21 - h11
                jac[q + k, q + w] += h11 - h12 - h21 + h22
                jac[q + k, s + w] += h12 - h22
                jac[s + k, p + w] -= h21
                jac[s + k, q + w] += h21 - h22
                jac[s + k, s + w] += h22
