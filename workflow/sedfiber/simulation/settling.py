"""Distance to the terminal shape, and the settling time T(ℬ, θ₀)."""

import numpy as np

from sedfiber.core.array_types import Array, History, Positions, Times

SETTLED = 1e-3  # of L: T is the first time after which the distance stays below this
CONFIRMED = 1e-4  # of L: how near a run comes before it is believed to stay below


def distance_to_terminal(shapes: History, terminal: Positions, length: float) -> Array:
    """Root-mean-square bead distance over ``L``, the free rotation about gravity taken out.

    ``shapes`` (..., N, 3) and ``terminal`` (N, 3) are relative to the centre bead.  A turn
    by φ about the vertical maps a steady shape onto a steady shape; the nearest one has
    ``tan φ = Σ(x' z − z' x) / Σ(x' x + z' z)``, primes on the terminal shape.  Returns (...,).
    """
    x, y, z = (shapes[..., k] for k in range(3))
    p, q, s = (terminal[..., k] for k in range(3))
    along = (p * x + s * z).sum(-1)
    across = (p * z - s * x).sum(-1)
    overlap = np.hypot(along, across)
    square = (x * x + z * z).sum(-1) + (p * p + s * s).sum() - 2.0 * overlap
    vertical = ((y - q) ** 2).sum(-1)
    mean = (np.maximum(square, 0.0) + vertical) / terminal.shape[0]
    return np.sqrt(mean) / length


def settling_time(t: Times, distance: Array) -> float | None:
    """First time after which ``distance`` stays below SETTLED; None when it does not.

    Between the last sample above and the first below, the distance is taken to fall
    exponentially.
    """
    above = np.flatnonzero(distance >= SETTLED)
    if above.size == 0:
        return float(t[0])
    last = above[-1]
    if last + 1 == len(t):
        return None
    high, low = np.log(distance[last : last + 2])
    return float(t[last] + (t[last + 1] - t[last]) * (high - np.log(SETTLED)) / (high - low))
