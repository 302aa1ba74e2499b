"""Where a mobility loses its meaning: a force that moves a bead against itself.

Plain Rotne–Prager–Yamakawa and Oseen have negative eigenvalues when beads overlap enough; the
beads then attract each other without limit.  The overlap form, and no hydrodynamics, never do.
"""

import numpy as np

from sedfiber._typing import Positions
from sedfiber.physics.protocols import Mobility

CLOSE = 1.9  # a: where every two beads are further apart than this, RPY is positive definite
REMEDY = "give hydrodynamics RPY-overlap, or add contact"


def closest_pair(x: Positions) -> tuple[int, int, float]:
    """The two beads whose centres are closest, and their distance; ``x`` (N, d)."""
    best = (0, 0, np.inf)
    for i in range(len(x) - 1):
        r = np.linalg.norm(x[i + 1 :] - x[i], axis=1)
        if r.min() < best[2]:
            best = (i, i + 1 + int(r.argmin()), float(r.min()))
    return best


def least_eigenvalue(mobility: Mobility, x: Positions) -> float:
    """The smallest eigenvalue of ``M(x)``, in 1/(6πμa); −∞ where it is not a number."""
    matrix = mobility.matrix(np.ascontiguousarray(x))
    return float(np.linalg.eigvalsh(matrix)[0]) if np.isfinite(matrix).all() else -np.inf


def indefinite_words(mobility: Mobility, x: Positions) -> str | None:
    """What is wrong with ``M(x)``, naming the closest pair; None where it is positive definite."""
    i, j, r = closest_pair(x)
    if not r < 2.0 or (least := least_eigenvalue(mobility, x)) > 0.0:
        return None
    return (
        f"the mobility is not positive definite (smallest eigenvalue {least:.2g}): "
        f"beads {i} and {j} are {r:.2g} a apart"
    )
