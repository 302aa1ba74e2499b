"""How a step of the workflow is called: the parameters of its function ``run`` are its command line.

A parameter whose annotation is one of the kinds below is an argument: positional, or ``--name`` where it is
keyword-only. Every other parameter is a key of ``--settings``, one JSON object.
"""

import argparse
import json
from collections.abc import Callable, Mapping
from inspect import Parameter, signature
from pathlib import Path
from typing import Any, NewType, TypeVar

from sedfiber.core.atomic_file import require_folder, require_writable
from sedfiber.core.errors import InputError

Made = TypeVar("Made")
Word = NewType("Word", str)
Split = NewType("Split", list[Path])  # samples, and terminal shapes of their ℬ: two Parquet files
Splits = NewType("Splits", list[Path])  # two files each
Output = NewType("Output", Path)  # a file to write
Folder = NewType("Folder", Path)  # a folder to write
_SEVERAL: dict[Any, int | str] = {list[Path]: "+", Splits: "+", Split: 2}
_KINDS = (Word, Path, Path | None, Output, Folder, *_SEVERAL)


def add_arguments(run: Callable, parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``run`` and, where it has some, its settings."""
    arguments, settings = _parted(run)
    for name, one in arguments.items():
        options: dict[str, Any] = {"type": str if one.annotation is Word else Path}
        if one.annotation in _SEVERAL:
            options |= {"nargs": _SEVERAL[one.annotation], "metavar": "FILE"}
        if one.kind is Parameter.KEYWORD_ONLY:
            options |= {"required": one.default is Parameter.empty, "default": one.default}
        names = ["-o", "--output"] if name == "output" else [f"--{name.replace('_', '-')}"]
        parser.add_argument(*(names if one.kind is Parameter.KEYWORD_ONLY else [name]), **options)
    if settings:
        parser.add_argument("--settings", default="{}", help=f"JSON object with {', '.join(settings)}")


def call(run: Callable, args: argparse.Namespace) -> None:
    """Check that the outputs can be written and the settings are known, then run; raises InputError."""
    arguments, settings = _parted(run)
    given = {name: getattr(args, name) for name in arguments}
    for name, one in arguments.items():
        if one.annotation is Output:
            require_writable(given[name])
    values = _values(args.settings, "settings", settings) if settings else {}
    for name, one in arguments.items():
        if one.annotation is Folder:
            require_folder(given[name])
    run(**given, **values)


def made_from(settings: Mapping[str, Any], make: Callable[..., Made], name: str) -> Made:
    """``make(**settings)``; lists become tuples.

    Raises InputError for what is no mapping, for a key that ``make`` does not know, and for one that it misses.
    """
    return make(**_values(settings, name, signature(make).parameters))


def _parted(run: Callable) -> tuple[dict[str, Parameter], dict[str, Parameter]]:
    """Arguments and settings of a step."""
    parameters = signature(run).parameters.items()
    arguments = {name: one for name, one in parameters if one.annotation in _KINDS}
    return arguments, {name: one for name, one in parameters if name not in arguments}


def _values(settings: str | Mapping[str, Any], name: str, known: Mapping[str, Parameter]) -> dict[str, Any]:
    values = _object(settings, name)
    for key in values:
        if key not in known:
            raise InputError(f"{name}: unknown key {key!r}; keys are {', '.join(sorted(known))}")
    for key, parameter in known.items():
        if parameter.default is Parameter.empty and key not in values:
            raise InputError(f"{key}: missing; give it in {name}")
    return {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}


def _object(settings: str | Mapping[str, Any], name: str) -> Mapping[str, Any]:
    try:
        values = json.loads(settings) if isinstance(settings, str) else settings
    except ValueError as error:
        raise InputError(f"{name}: not a JSON object ({error})") from None
    if not isinstance(values, Mapping):
        raise InputError(f"{name}: not a JSON object; give one such as {{}}")
    return values
