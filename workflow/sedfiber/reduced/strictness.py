"""A forecast's warnings as one line, or, with ``--strict``, as an error."""

from sedfiber.core.errors import InputError
from sedfiber.simulation.trajectory import Trajectory


def warning_line(trajectory: Trajectory, strict: bool, place: str = "") -> str:
    """The warnings of a forecast in one line, empty where there is none; raises InputError for any if ``strict``."""
    words = "; ".join(trajectory.metadata["model"]["warnings"])
    if words and strict:
        raise refusal(place + words)
    return place + words if words else ""


def refusal(words: str) -> InputError:
    """The error of ``--strict`` for a forecast with warnings."""
    return InputError(f"strict: {words}; give values of the training, or leave out --strict")
