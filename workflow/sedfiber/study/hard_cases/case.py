"""A hard case: why it is hard, its criterion, its reference, and the function that measures it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from sedfiber.core.errors import SedfiberError

FOLDER = "sedfiber.study.hard_cases"


@dataclass(frozen=True)
class Measurement:
    """One number that a case is judged by: right when ``value <= bound`` (a NaN is wrong).

    ``what`` names the number with its unit; ``note`` says what a reader should know, and why it
    fails where it fails.
    """

    what: str
    value: float
    bound: float
    note: str = ""

    @property
    def right(self) -> bool:
        """Whether the number keeps its bound."""
        return bool(self.value <= self.bound)


@dataclass(frozen=True)
class HardCase:
    """One entry of the list that tests and the rule ``hard_cases`` both run.

    ``module`` is the module of this folder that measures it, in the function of the case's own
    name; it is imported when the case is run, so that the list itself costs nothing.
    """

    name: str
    module: str
    why: str
    right: str
    reference: str
    needs_model: bool = False

    def measure(self, model: Path | None = None) -> list[Measurement]:
        """Run the case; ``model`` is the folder of a trained forecast model, where the case needs one."""
        function: Callable[..., Iterable[Measurement]] = getattr(import_module(f"{FOLDER}.{self.module}"), self.name)
        return list(function(model) if self.needs_model else function())


def must_refuse(what: str, action: Callable[[], object], *words: str) -> Measurement:
    """Right (0) when ``action`` raises an error of one line with all ``words``; the note is that line."""
    try:
        action()
    except SedfiberError as error:
        line = str(error)
        return yes_or_no(what, "\n" not in line and all(word in line for word in words), line)
    return yes_or_no(what, False, "it went through")


def yes_or_no(what: str, right: bool, note: str = "") -> Measurement:
    """Something that is either right (0) or not (1)."""
    return Measurement(what, 0.0 if right else 1.0, 0.0, note)
