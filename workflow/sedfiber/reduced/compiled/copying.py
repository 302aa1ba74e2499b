"""Copies as plain loops: numba compiles ``target[:] = source`` with the checks of all broadcasting, for seconds."""

from sedfiber.core.array_types import Array
from sedfiber.core.kernel_cache import kept


@kept()
def copy(source: Array, target: Array) -> None:
    """The numbers of ``source`` (n,) to the first places of ``target``."""
    for i in range(source.size):
        target[i] = source[i]


@kept()
def copy_rows(source: Array, target: Array) -> None:
    """The first columns of ``source`` (rows, ≥ n) to ``target`` (rows, n)."""
    for s in range(target.shape[0]):
        for i in range(target.shape[1]):
            target[s, i] = source[s, i]
