"""The study's grid of inclinations, θ₀ = k π/48: files and keys hold k, never a rounded angle."""

import math

from sedfiber.core.validation import whole_number

ANGLES_PER_HALF_TURN = 48


def angle_index(value: str | int) -> int:
    """k as a whole number from 0 to 48, or InputError."""
    most = ANGLES_PER_HALF_TURN
    return whole_number("angle_index", value, f"a whole number from 0 to {most}", 0, most)


def angle_of(index: str | int) -> float:
    """θ₀ in radians at ``index``, or InputError for one off the grid."""
    return angle_index(index) * math.pi / ANGLES_PER_HALF_TURN
