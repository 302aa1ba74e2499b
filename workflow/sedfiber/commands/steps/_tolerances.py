"""Tolerances to try, as a step is given them."""

from collections.abc import Sequence

from sedfiber.core.validation import number_within


def tolerance_ladder(key: str, values: Sequence[float], least: float = 1e-12) -> list[float]:
    """``values`` as numbers from ``least`` to 0.1; raises InputError that names ``key``."""
    return [number_within(key, value, least, 0.1, f"numbers from {least:g} to 0.1") for value in values]
