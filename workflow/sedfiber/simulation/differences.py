"""Distances between two histories of the same fiber."""

import numpy as np

from sedfiber.core.array_types import Array, History


def rms_distance(one: History, other: History, length: float) -> Array:
    """Root-mean-square bead distance over L at each sample, (T,), of positions (T, N, 3); the fall included."""
    return np.sqrt(((one - other) ** 2).sum(axis=-1).mean(axis=-1)) / length


def largest_distance(one: History, other: History, length: float) -> float:
    """The largest of ``rms_distance`` over all samples."""
    return float(rms_distance(one, other, length).max())
