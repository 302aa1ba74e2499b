"""The settings of a step: one JSON object whose keys are the arguments of a function."""

import argparse
import json
from collections.abc import Callable, Mapping
from inspect import Parameter, signature
from pathlib import Path
from typing import Any, TypeVar

from sedfiber.core.errors import InputError

Made = TypeVar("Made")


def add_settings_and_output(parser: argparse.ArgumentParser, output: str) -> None:
    """``--settings JSON`` and ``-o OUTPUT``, which ``output`` describes."""
    parser.add_argument("--settings", default="{}", help="JSON object (the defaults)")
    parser.add_argument("-o", "--output", type=Path, required=True, help=output)


def made_from(settings: str | Mapping[str, Any], make: Callable[..., Made], name: str = "settings") -> Made:
    """``make(**settings)``, where ``settings`` is a JSON object or its contents; lists become tuples.

    Raises InputError for text that is no object, for a key that ``make`` does not know, and for one that it misses.
    """
    values = _object(settings, name)
    known = signature(make).parameters
    for key in values:
        if key not in known:
            raise InputError(f"{name}: unknown key {key!r}; keys are {', '.join(sorted(known))}")
    for key, parameter in known.items():
        if parameter.default is Parameter.empty and key not in values:
            raise InputError(f"{key}: missing; give it in {name}")
    return make(**{key: tuple(value) if isinstance(value, list) else value for key, value in values.items()})


def _object(settings: str | Mapping[str, Any], name: str) -> Mapping[str, Any]:
    try:
        values = json.loads(settings) if isinstance(settings, str) else settings
    except ValueError as error:
        raise InputError(f"{name}: not a JSON object ({error})") from None
    if not isinstance(values, Mapping):
        raise InputError(f"{name}: not a JSON object; give one such as {{}}")
    return values
