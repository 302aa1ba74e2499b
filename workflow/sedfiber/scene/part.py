"""The base of all parts of a scene: parameters with a unit, and reading from plain values."""

from collections.abc import Callable
from dataclasses import MISSING, asdict, dataclass, field, fields
from typing import Any, ClassVar, Self

from sedfiber.core.errors import InputError


def parameter(unit: str, meaning: str, default: Any = MISSING) -> Any:
    """A field of a part, with what ``sedfiber effects`` prints of it."""
    return field(default=default, metadata={"unit": unit, "meaning": meaning})


@dataclass(frozen=True)
class Part:
    """The base of all parts: a key of the scene, a summary, a source, and reading from plain values."""

    key: ClassVar[str]
    summary: ClassVar[str]
    source: ClassVar[str]
    acts_in: ClassVar[str]

    @classmethod
    def read(cls, value: Any) -> Self | None:
        """A part from a mapping, from itself, or None from None or "none"; raises InputError."""
        if value is None or value == "none":
            return None
        if isinstance(value, cls):
            return value
        if not isinstance(value, dict):
            raise InputError(f"{cls.key}: {value!r} is not allowed; give none or {{{', '.join(cls.names())}}}")
        for name in value:
            if name not in cls.names():
                raise InputError(f"{cls.key}: unknown key {name!r}; keys are {', '.join(cls.names())}")
        for one in fields(cls):
            if one.default is MISSING and one.name not in value:
                raise InputError(f"{cls.key}: missing key {one.name!r}; it is {one.metadata['meaning']}")
        return cls(**value)

    @classmethod
    def names(cls) -> list[str]:
        """Names of the part's parameters."""
        return [one.name for one in fields(cls)]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for a file's metadata; parameters that were left open are left out."""
        return {name: _as_lists(value) for name, value in asdict(self).items() if value is not None}

    def _check(self, check: Callable, name: str, *more: Any) -> None:
        """Store what ``check`` makes of one parameter, named with the part's key."""
        object.__setattr__(self, name, check(f"{self.key}.{name}", getattr(self, name), *more))


def _as_lists(value: Any) -> Any:
    """Tuples as the lists that JSON makes of them."""
    return [_as_lists(one) for one in value] if isinstance(value, tuple) else value
