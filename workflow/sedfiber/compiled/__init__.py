"""Forecasts in compiled code."""

from pathlib import Path

from sedfiber.kernel_cache import forget_stale_kernels

forget_stale_kernels(Path(__file__).parent)
