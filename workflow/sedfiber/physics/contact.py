"""Contact: a short-range repulsion that keeps beads from running into each other."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sedfiber.core.array_types import Matrix, Positions
from sedfiber.physics.kernel import kernel


@dataclass(frozen=True)
class Contact:
    """Repulsion of bead pairs nearer than ``reach``, ``R > 2``; neighbours along a fiber feel none.

    On bead ``i``, with ``r = |x_i − x_j| < R`` and ``q = (R² − r²)/(R² − 4)``,

        F = (S/2) q⁴ (x_i − x_j),    U = S (R² − r²)⁵ / (20 (R² − 4)⁴)

    in units of ``6πμaU_s`` and of that times ``a``.  ``strength`` S is the force between touching
    beads, r = 2.  Source: Dance, Climent & Maxey 2004 with the exponent 2γ = 4, so that the
    force and three of its derivatives vanish at R.  Two beads right on top of each other feel
    nothing, at the price of ``S R¹⁰/(20 (R² − 4)⁴)``.

    Beads are numbered one fiber of ``fiber_beads`` after another.
    """

    strength: float
    reach: float
    fiber_beads: int

    needs_lab_frame: ClassVar[bool] = False
    banded: ClassVar[bool] = False

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the repulsion to ``force``, shape (N, d); beads out of reach are not written to."""
        _add_force(x, self.strength, self.reach, self.fiber_beads, force)

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``∂F/∂x`` to ``jac``, at least (N d, N d)."""
        _add_jacobian(x, self.strength, self.reach, self.fiber_beads, jac)

    def energy(self, x: Positions) -> float:
        """``Σ S (R² − r²)⁵ / (20 (R² − 4)⁴)`` over the pairs in reach."""
        return _energy(x, self.strength, self.reach, self.fiber_beads)


@kernel()
def _first_partner(i, fiber_beads):
    """First of the later beads that bead ``i`` can touch: the one after next, but next to a fiber's end."""
    return i + 1 if (i + 1) % fiber_beads == 0 else i + 2


@kernel()
def _square(x, i, j):
    """``|x_i − x_j|²``."""
    dx, dy = x[i, 0] - x[j, 0], x[i, 1] - x[j, 1]
    dz = x[i, 2] - x[j, 2] if x.shape[1] == 3 else 0.0
    return dx * dx + dy * dy + dz * dz


@kernel()
def _energy(x, strength, reach, fiber_beads):
    width = reach * reach - 4.0
    total = 0.0
    for i in range(x.shape[0]):
        for j in range(_first_partner(i, fiber_beads), x.shape[0]):
            depth = reach * reach - _square(x, i, j)
            if depth > 0.0:
                total += depth * (depth / width) ** 4
    return strength / 20.0 * total


@kernel()
def _add_force(x, strength, reach, fiber_beads, force):
    reach2 = reach * reach
    for i in range(x.shape[0]):
        for j in range(_first_partner(i, fiber_beads), x.shape[0]):
            r2 = _square(x, i, j)
            if r2 < reach2:
                push = 0.5 * strength * ((reach2 - r2) / (reach2 - 4.0)) ** 4
                for k in range(x.shape[1]):
                    along = push * (x[i, k] - x[j, k])
                    force[i, k] += along
                    force[j, k] -= along


@kernel()
def _add_jacobian(x, strength, reach, fiber_beads, jac):
    n, d = x.shape
    reach2 = reach * reach
    r = np.empty(d)
    for i in range(n):
        for j in range(_first_partner(i, fiber_beads), n):
            r2 = _square(x, i, j)
            if r2 < reach2:
                for k in range(d):
                    r[k] = x[i, k] - x[j, k]
                q = (reach2 - r2) / (reach2 - 4.0)
                push = 0.5 * strength * q**4
                slope = -4.0 * strength * q**3 / (reach2 - 4.0)  # twice its derivative by r²
                for k in range(d):
                    for w in range(d):
                        h = slope * r[k] * r[w] + (push if k == w else 0.0)
                        jac[i * d + k, i * d + w] += h
                        jac[j * d + k, j * d + w] += h
                        jac[i * d + k, j * d + w] -= h
                        jac[j * d + k, i * d + w] -= h
