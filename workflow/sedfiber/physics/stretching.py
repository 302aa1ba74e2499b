"""Stretching: one linear spring per bond, ``U = ℰ Σ_bonds (r/2 − 1)²``."""

from dataclasses import dataclass

import numpy as np
from numba import njit

from sedfiber._typing import Matrix, Positions


@dataclass(frozen=True)
class Stretching:
    """Springs of rest length 2a between neighbours (DESIGN: Û, first sum).

    The force on the outer end of a bond of length ``r`` and direction ``r̂`` is
    ``−ℰ (r/2 − 1) r̂``, in units of ``6πμaU_s``.  Source: Schlagberger & Netz 2005,
    with ``S = Eπa²``, made dimensionless by ``ℰ = Eπa²/(6πμaU_s)``.
    """

    modulus: float

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the spring forces to ``force``, shape (N, d)."""
        _add_force(x, self.modulus, force)

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``∂F/∂x`` to ``jac``, shape (N d, N d)."""
        _add_jacobian(x, self.modulus, jac)

    def energy(self, x: Positions) -> float:
        """``ℰ Σ (r/2 − 1)²`` in units of ``6πμaU_s · a``."""
        return _energy(x, self.modulus)


@njit(cache=True)
def _energy(x, modulus):
    total = 0.0
    for j in range(x.shape[0] - 1):
        r2 = 0.0
        for k in range(x.shape[1]):
            r2 += (x[j + 1, k] - x[j, k]) ** 2
        total += (0.5 * np.sqrt(r2) - 1.0) ** 2
    return modulus * total


@njit(cache=True)
def _add_force(x, modulus, force):
    n, d = x.shape
    for j in range(n - 1):
        r2 = 0.0
        for k in range(d):
            r2 += (x[j + 1, k] - x[j, k]) ** 2
        r = np.sqrt(r2)
        tension = modulus * (0.5 * r - 1.0) / r
        for k in range(d):
            pull = tension * (x[j + 1, k] - x[j, k])
            force[j, k] += pull
            force[j + 1, k] -= pull


@njit(cache=True)
def _add_jacobian(x, modulus, jac):
    n, d = x.shape
    b = np.empty(d)
    for j in range(n - 1):
        r2 = 0.0
        for k in range(d):
            b[k] = x[j + 1, k] - x[j, k]
            r2 += b[k] * b[k]
        r = np.sqrt(r2)
        across = modulus * (0.5 * r - 1.0) / r
        along = (0.5 * modulus - across) / r2
        p, q = j * d, (j + 1) * d
        for k in range(d):
            for w in range(d):
                h = along * b[k] * b[w] + (across if k == w else 0.0)
                jac[p + k, p + w] -= h
                jac[q + k, q + w] -= h
                jac[p + k, q + w] += h
                jac[q + k, p + w] += h
