"""One-line checks of single values, shared by scenes, commands and settings."""

import math
import re
from collections.abc import Iterable, Sequence
from typing import Any

from sedfiber.core.errors import InputError

# numbers that YAML 1.1 takes for text, for want of a point or a sign
EXPONENT = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$")


def finite_number(key: str, value: Any, allowed: str = "a finite number") -> float:
    """``value`` as a float; raises InputError for text, NaN, infinities and booleans."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise refused(key, value, allowed) from None
    if not math.isfinite(number):
        raise refused(key, value, allowed)
    return number


def positive_number(key: str, value: Any, allowed: str = "a finite number above 0") -> float:
    """``value`` as a float above zero, or InputError."""
    number = finite_number(key, value, allowed)
    if number <= 0.0:
        raise refused(key, value, allowed)
    return number


def whole_number(key: str, value: Any, allowed: str, least: int = 0, most: float = math.inf) -> int:
    """``value`` as an int from ``least`` to ``most``, or InputError."""
    exact = isinstance(value, int) and not isinstance(value, bool)  # a float would round a large seed
    number = value if exact else finite_number(key, value, allowed)
    if number != int(number) or not least <= number <= most:
        raise refused(key, value, allowed)
    return int(number)


def number_within(key: str, value: Any, low: float, high: float, allowed: str) -> float:
    """``value`` as a float from ``low`` to ``high``, or InputError."""
    number = finite_number(key, value, allowed)
    if not low <= number <= high:
        raise refused(key, value, allowed)
    return number


def one_of(key: str, value: Any, choices: Iterable[str]) -> str:
    """``value`` if it is among ``choices``, or InputError listing them."""
    choices = tuple(choices)
    if value not in choices:
        raise refused(key, value, "one of " + ", ".join(choices))
    return value


def vector(key: str, value: Any) -> tuple[float, float, float]:
    """``value`` as three finite numbers; two stand for x and y.  Raises InputError."""
    allowed, value = "a list of two or three finite numbers", plain(value)
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) not in (2, 3):
        raise refused(key, value, allowed)
    x, y, z = (finite_number(key, component, allowed) for component in (*value, 0.0)[:3])
    return x, y, z


def velocity_gradient(key: str, value: Any) -> tuple:
    """``value`` as three rows of three numbers, from two rows of two or three of three, or InputError."""
    allowed = "two rows of two or three rows of three finite numbers, G in u = G·x, whose diagonal adds up to 0"
    rows = plain(value)
    square = isinstance(rows, list | tuple) and len(rows) in (2, 3)
    if not square or any(not isinstance(row, list | tuple) or len(row) != len(rows) for row in rows):
        raise refused(key, rows, allowed)
    numbers = [[finite_number(key, entry, allowed) for entry in row] for row in rows]
    if abs(sum(numbers[k][k] for k in range(len(rows)))) > 1e-12 * max(abs(e) for row in numbers for e in row):
        raise refused(key, rows, f"{allowed} (the fluid is incompressible)")
    padded = [(*row, 0.0)[:3] for row in numbers] + [(0.0, 0.0, 0.0)]
    return tuple(padded[:3])


def direction(key: str, value: Any) -> tuple[float, float, float]:
    """``value`` as a vector of length one, or InputError."""
    x, y, z = vector(key, value)
    length = math.hypot(x, y, z)
    if length == 0.0:
        raise refused(key, value, "a direction that is not zero")
    return (x, y, z) if length == 1.0 else (x / length, y / length, z / length)


def plain(value: Any) -> Any:
    """An array as lists, which a scene's record can hold; other values as they are."""
    return value.tolist() if hasattr(value, "tolist") else value


def yes_or_no(key: str, value: Any) -> bool:
    """``value`` if it is true or false, or InputError."""
    if not isinstance(value, bool):
        raise refused(key, value, "true or false")
    return value


def refused(key: str, value: Any, allowed: str) -> InputError:
    """The error for one key: its name, the value given and what is allowed."""
    shown = " ".join(repr(value).split())  # an array's is several lines
    return InputError(f"{key}: {shown} is not allowed; give {allowed}")
