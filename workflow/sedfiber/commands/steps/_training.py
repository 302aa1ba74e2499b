"""Options and steps that the training commands share."""

import argparse
import json
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

from sedfiber.core.errors import InputError
from sedfiber.core.validation import whole_number

Settings = TypeVar("Settings")


def add_data_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set to learn from and the steady shapes of its ℬ."""
    parser.add_argument("--dataset", type=Path, required=True, help="Parquet file of the training split")
    parser.add_argument("--terminal-shapes", type=Path, required=True, help="Parquet file of its steady shapes")


def add_training_arguments(parser: argparse.ArgumentParser) -> None:
    """Seed, settings and where the model goes."""
    add_data_arguments(parser)
    parser.add_argument("--seed", default=0, help="draws weights and batches (0)")
    parser.add_argument("--settings", default="{}", help="JSON object of hyper-parameters (the defaults)")
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder of the model")


def seed_of(args: argparse.Namespace) -> int:
    """The seed, validated."""
    return whole_number("seed", args.seed, "a whole number from 0 up")


def settings_of(text: str, kind: type[Settings], option: str = "settings") -> Settings:
    """The JSON object of ``option`` as the dataclass ``kind``; lists become tuples; unknown keys are refused."""
    try:
        values = json.loads(text)
    except ValueError as error:
        raise InputError(f"{option}: not a JSON object ({error})") from None
    if not isinstance(values, dict):
        raise InputError(f"{option}: not a JSON object; give one such as {{}}")
    known = {field.name for field in fields(kind)}
    for key in values:
        if key not in known:
            raise InputError(f"{option}: unknown key {key!r}; keys are {', '.join(sorted(known))}")
    return kind(**{key: _hashable(value) for key, value in values.items()})


def say(line: str) -> None:
    """Print a progress line at once."""
    print(line, flush=True)


def _hashable(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
