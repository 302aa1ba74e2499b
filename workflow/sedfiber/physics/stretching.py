"""Stretching: one linear spring per bond, ``U = ℰ Σ_bonds (r/2 − 1)²``."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sedfiber.core.array_types import Band, Positions
from sedfiber.physics.kernel import kernel
from sedfiber.physics.protocols import TO_THE_LAST


@dataclass(frozen=True)
class Stretching:
    """Springs of rest length 2a between neighbours (DESIGN: Û, first sum).

    The force on the outer end of a bond of length ``r`` and direction ``r̂`` is
    ``−ℰ (r/2 − 1) r̂``, in units of ``6πμaU_s``.  Source: Schlagberger & Netz 2005,
    with ``S = Eπa²``, made dimensionless by ``ℰ = Eπa²/(6πμaU_s)``.  The fiber is made of the
    beads from ``first`` to before ``last``.
    """

    modulus: float
    first: int = 0
    last: int = TO_THE_LAST

    needs_lab_frame: ClassVar[bool] = False
    banded: ClassVar[bool] = True

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the spring forces to ``force``, shape (N, d)."""
        _add_force(x, self.modulus, self.first, self.last, force)

    def add_jacobian(self, x: Positions, jac: Band) -> None:
        """Add ``∂F/∂x`` to the band ``jac``, shape (5, d, d, N)."""
        _add_jacobian(x, self.modulus, self.first, self.last, jac)

    def energy(self, x: Positions) -> float:
        """``ℰ Σ (r/2 − 1)²`` in units of ``6πμaU_s · a``."""
        return _energy(x, self.modulus, self.first, self.last)


@kernel()
def _energy(x, modulus, first, last):
    total = 0.0
    for j in range(first, min(last, x.shape[0]) - 1):
        r2 = 0.0
        for k in range(x.shape[1]):
            r2 += (x[j + 1, k] - x[j, k]) ** 2
        total += (0.5 * np.sqrt(r2) - 1.0) ** 2
    return modulus * total


@kernel()
def _add_force(x, modulus, first, last, force):
    spatial = x.shape[1] == 3
    end = min(last, x.shape[0]) - 1
    px = py = pz = 0.0  # the pull of the bond before
    for j in range(first, end):
        bx = x[j + 1, 0] - x[j, 0]
        by = x[j + 1, 1] - x[j, 1]
        bz = x[j + 1, 2] - x[j, 2] if spatial else 0.0
        r = np.sqrt(bx * bx + by * by + bz * bz)
        tension = modulus * (0.5 * r - 1.0) / r
        force[j, 0] += tension * bx - px
        force[j, 1] += tension * by - py
        if spatial:
            force[j, 2] += tension * bz - pz
        px, py, pz = tension * bx, tension * by, tension * bz
    force[end, 0] -= px
    force[end, 1] -= py
    if spatial:
        force[end, 2] -= pz


@kernel()
def _add_jacobian(x, modulus, first, last, band):
    d = x.shape[1]
    b = np.empty(d)
    for j in range(first, min(last, x.shape[0]) - 1):
        r2 = 0.0
        for k in range(d):
            b[k] = x[j + 1, k] - x[j, k]
            r2 += b[k] * b[k]
        r = np.sqrt(r2)
        across = modulus * (0.5 * r - 1.0) / r
        along = (0.5 * modulus - across) / r2
        for k in range(d):
            for w in range(d):
                h = along * b[k] * b[w] + (across if k == w else 0.0)
                band[2, k, w, j] -= h
                band[2, k, w, j + 1] -= h
                band[3, k, w, j] += h
                band[1, k, w, j + 1] += h
