"""The compiler of the physics' kernels: cached on disk, dividing by zero as NumPy does.

A trial step of a solver may put two beads into one place. An exception raised there would pass through the
solver's own compiled code; a number that is not finite makes it reject the step.
"""

from collections.abc import Callable
from typing import Any

from sedfiber.core.kernel_cache import Function, kept


def kernel(**options: Any) -> Callable[[Function], Function]:
    """Compile with these options of ``numba.njit`` besides, and keep the result on disk."""
    return kept(error_model="numpy", **options)
