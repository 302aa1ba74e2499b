"""Samples spread evenly along the path of a trajectory, rather than evenly in time.

A settling fiber spends most of its time next to the terminal shape; samples even in time
would drown the transient. The path coordinate of a trajectory is

    ds² = |dX̌|² + κ² |dc|²                 (both in units of L/2)

where the small share κ of the centre's motion bounds the time between two samples.
"""

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.reduced.dataset import SettlingFall
from sedfiber.reduced.scaling import Scales, residual_history

# The centre travels 10 to 100 half lengths, the shape 0.3 to 8; 0.02 keeps the centre's
# share of the path below one half, and the longest gap between samples below 20 a/U_s.
CENTRE_SHARE = 0.02


def path_coordinate(trajectory: SettlingFall, scales: Scales) -> Array:
    """Path length from the start to each stored sample, shape (T,), units L/2."""
    shape_steps = np.diff(residual_history(trajectory, scales), axis=0)
    centre_steps = np.diff(scales.centre(trajectory.positions), axis=0)
    squared = (shape_steps**2).sum(axis=1) + CENTRE_SHARE**2 * (centre_steps**2).sum(axis=1)
    return np.concatenate([[0.0], np.cumsum(np.sqrt(squared))])


def path_even_indices(trajectory: SettlingFall, scales: Scales, count: int) -> Array:
    """Indices of the ``count`` stored samples nearest to an even division of the path.

    Shape (count,), ascending, first and last sample included. Stored samples are taken
    rather than values interpolated between them, so no interpolation error enters; where
    the path is long between two samples an index appears twice.
    """
    path = path_coordinate(trajectory, scales)
    wanted = np.linspace(0.0, path[-1], count)
    right = np.clip(np.searchsorted(path, wanted), 1, len(path) - 1)
    left_is_nearer = wanted - path[right - 1] < path[right] - wanted
    return np.where(left_is_nearer, right - 1, right)
