"""Mobilities summed over bead pairs: Oseen, and Rotne–Prager–Yamakawa with or without its overlap form."""

import numpy as np

from sedfiber.core.array_types import Band, Matrix, Positions
from sedfiber.physics import pair_plane, pair_volume
from sedfiber.physics.kernel import kernel
from sedfiber.physics.pair_forms import OSEEN, RPY, RPY_OVERLAP, coefficients

FORMS = {"Oseen": OSEEN, "RPY": RPY, "RPY-overlap": RPY_OVERLAP}


class PairMobility:
    """``M_ii = I``, ``M_ij = c1(r) I + c2(r) r̂ r̂ᵀ`` in units ``1/(6πμa)``; see ``pair_forms``.

    Oseen's far field alone loses positive definiteness in a chain of more than a few touching
    beads; plain RPY, as Fox & Graham 2024 print it, when beads overlap enough; the overlap form never.
    """

    needs_lab_frame = False

    def __init__(self, form: str, dim: int):
        kernels = {2: pair_plane, 3: pair_volume}[dim]
        self._form = FORMS[form]
        self._velocities, self._linearise = kernels.velocities, kernels.linearise

    def velocity(self, x: Positions, force: Positions, u: Positions) -> None:
        """Write ``M(x) F`` to ``u``, shape (N, d)."""
        self._velocities(x, force, self._form, u)

    def matrix(self, x: Positions) -> Matrix:
        """``M(x)``, shape (N d, N d), symmetric."""
        m = np.empty((x.size, x.size))
        _fill_matrix(x, self._form, m)
        return m

    def linearise(self, x: Positions, force: Positions, band: Band, u: Positions, jac: Matrix) -> None:
        """Write ``M F`` to ``u`` and add ``M ∂F/∂x + (∂M/∂x) F`` to ``jac``, at least (N d, N d)."""
        self._linearise(x, force, band, self._form, u, jac)


@kernel()
def _fill_matrix(x: Positions, form: int, m: Matrix) -> None:
    n, d = x.shape
    r = np.empty(d)
    for i in range(n):
        for j in range(i + 1):
            r2 = 0.0
            for k in range(d):
                r[k] = x[i, k] - x[j, k]
                r2 += r[k] * r[k]
            c1, e2, _, _ = coefficients(r2, form)
            c1 = 1.0 if i == j else c1
            for k in range(d):
                for w in range(d):
                    block = e2 * r[k] * r[w] + (c1 if k == w else 0.0)
                    m[i * d + k, j * d + w] = block
                    m[j * d + w, i * d + k] = block
