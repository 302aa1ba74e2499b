"""Distances between beads."""

import numpy as np
from numba import njit

from sedfiber._typing import Positions


@njit(cache=True)
def smallest_gap(x: Positions) -> float:
    """Smallest centre distance between beads that are not neighbours, less one diameter."""
    n, d = x.shape
    best = np.inf
    for i in range(n):
        for j in range(i - 1):
            r2 = 0.0
            for k in range(d):
                r2 += (x[i, k] - x[j, k]) ** 2
            best = min(best, r2)
    return np.sqrt(best) - 2.0
