"""Detection of mobilities that are not positive definite: a force would move a bead against itself.

Plain Rotne–Prager–Yamakawa and Oseen have negative eigenvalues when beads overlap enough; the
beads then attract each other without limit.  The overlap form, and no hydrodynamics, never do.
"""

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.physics.protocols import Mobility

CLOSE = 1.9  # a: where every two beads are further apart than this, RPY is positive definite
DEEPEST = 0.1  # a: how deep in a wall a bead may be; from about 0.35 on it is pushed against the force on it
OVERLAP_REMEDY = "give hydrodynamics RPY-overlap"


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


def wall_blame(mobility: Mobility, x: Positions) -> tuple[str, str] | None:
    """Which bead is too deep in the wall of the mobility, and what to try; None without a wall, or above it."""
    wall = getattr(mobility, "wall", None)  # only a mobility near one has it
    if wall is None or not (heights := wall.heights(x)).min() < 1.0 - DEEPEST:
        return None
    lowest = int(heights.argmin())
    remedy = "give a larger contact.strength" if getattr(mobility, "has_contact", False) else "add contact"
    return (
        f"bead {lowest} is {heights[lowest]:.3g} a from the wall, less than its radius,",
        f"{remedy}, or a smaller t_end",
    )


def indefinite_words(mobility: Mobility, x: Positions) -> str | None:
    """What is wrong with ``M(x)``, naming the closest pair; None where it is positive definite."""
    i, j, r = closest_pair(x)
    if not r < 2.0 or (least := least_eigenvalue(mobility, x)) > 0.0:
        return None
    return (
        f"the mobility is not positive definite (smallest eigenvalue {least:.2g}): "
        f"beads {i} and {j} are {r:.2g} a apart"
    )
