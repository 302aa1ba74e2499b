"""Splits of the data set as steps are given them, and what a training prints."""

from collections.abc import Sequence
from pathlib import Path

from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset, read_dataset


def read_splits(paths: Sequence[Path]) -> list[Dataset]:
    """The splits of ``paths``, two files each; raises InputError for an odd number."""
    if len(paths) % 2:
        raise InputError(f"input: {len(paths)} files are not allowed; give samples and terminal shapes of each split")
    return [read_dataset(*pair) for pair in zip(paths[::2], paths[1::2], strict=True)]


def say(line: str) -> None:
    """Print a progress line at once."""
    print(line, flush=True)
