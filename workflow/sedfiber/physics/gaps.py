"""Distances between beads."""

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.physics.kernel import kernel


@kernel()
def smallest_gap(x: Positions, fiber_beads: int) -> float:
    """Smallest centre distance between beads that are not neighbours in a fiber, less one diameter."""
    n, d = x.shape
    best = np.inf
    for i in range(n):
        for j in range(i):
            if j == i - 1 and i % fiber_beads != 0:
                continue
            r2 = 0.0
            for k in range(d):
                r2 += (x[i, k] - x[j, k]) ** 2
            best = min(best, r2)
    return np.sqrt(best) - 2.0


@kernel()
def closest_distance(x: Positions) -> float:
    """Smallest distance of two bead centres, neighbours included."""
    n, d = x.shape
    best = np.inf
    for i in range(n):
        for j in range(i):
            r2 = 0.0
            for k in range(d):
                r2 += (x[i, k] - x[j, k]) ** 2
            best = min(best, r2)
    return np.sqrt(best)
