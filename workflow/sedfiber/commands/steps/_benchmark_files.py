"""The seconds that Snakemake's benchmark files record."""

from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from sedfiber.core.errors import InputError


def seconds_of(paths: Iterable[Path]) -> float:
    """Sum of the seconds of some jobs; raises InputError for a file that is not Snakemake's."""
    return sum(_seconds(path) for path in paths)


def _seconds(path: Path) -> float:
    try:
        return float(pd.read_csv(path, sep="\t").iloc[-1]["s"])
    except (OSError, KeyError, IndexError, ValueError) as error:
        raise InputError(f"input: {str(path)!r} is not a benchmark file ({error})") from None
