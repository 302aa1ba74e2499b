"""One start as the kernels, and plain NumPy, take it."""

from typing import NamedTuple

from sedfiber.core.array_types import Array, Positions


class Origin(NamedTuple):
    """See `learning.start` for where it comes from.

    ``encoder`` (d, 3N) takes shapes in ``a`` to h, ``b`` is the scaled ln ℬ that the networks are
    asked at, and ``anchor`` (N, 3) is the terminal shape there.
    """

    encoder: Array
    b: float
    anchor: Positions
    initial: Positions
    terminal: Positions
    velocity: Array
    pace: float
