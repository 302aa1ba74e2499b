"""Splits of the data set as arguments of steps, and what a training prints."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset, read_dataset


def add_split(parser: argparse.ArgumentParser, name: str, what: str) -> None:
    """A split: the Parquet file of its samples, then that of the terminal shapes of its ℬ."""
    words = f"{what}: samples and terminal shapes, two Parquet files"
    parser.add_argument(name, nargs=2, type=Path, metavar="FILE", help=words, **_required(name))


def add_splits(parser: argparse.ArgumentParser, name: str, what: str) -> None:
    """One split or several, two files each."""
    words = f"{what}: samples and terminal shapes of each, two Parquet files"
    parser.add_argument(name, nargs="+", type=Path, metavar="FILE", help=words, **_required(name))


def read_splits(paths: Sequence[Path]) -> list[Dataset]:
    """The splits of ``paths``, two files each; raises InputError for an odd number."""
    if len(paths) % 2:
        raise InputError(f"input: {len(paths)} files are not allowed; give samples and terminal shapes of each split")
    return [read_dataset(*pair) for pair in zip(paths[::2], paths[1::2], strict=True)]


def say(line: str) -> None:
    """Print a progress line at once."""
    print(line, flush=True)


def _required(name: str) -> dict[str, Any]:
    return {"required": True} if name.startswith("-") else {}
