"""How kernels of the physics are compiled: kept on disk, and dividing by zero as NumPy does.

A trial step of a solver may put two beads into one place. An exception raised there would pass through the
solver's own compiled code; a number that is not finite makes it reject the step.
"""

from functools import partial

from sedfiber.core.kernel_cache import kept

kernel = partial(kept, error_model="numpy")
