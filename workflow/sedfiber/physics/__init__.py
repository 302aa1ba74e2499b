"""The mechanics of fibers: effects, mobilities, integrators, steady states."""

from pathlib import Path

from sedfiber.kernel_cache import forget_stale_kernels

forget_stale_kernels(Path(__file__).parent)
