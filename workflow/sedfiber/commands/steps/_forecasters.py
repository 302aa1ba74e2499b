"""Options and steps of the commands that judge several forecasters on several test splits."""

import argparse
from collections.abc import Iterator
from pathlib import Path

from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset, read_dataset
from sedfiber.study.error_tables import ModelLabel

_RECIPES = ("rollout", "source", "lookup")


def add_forecaster_arguments(parser: argparse.ArgumentParser) -> None:
    """True splits, and forecasts of each by each forecaster."""
    parser.add_argument("--truth", nargs="+", type=Path, required=True, help="Parquet files of the test splits")
    parser.add_argument("--shapes", nargs="+", type=Path, required=True, help="their steady shapes, in order")
    parser.add_argument(
        "--forecaster",
        nargs="+",
        action="append",
        required=True,
        metavar="WORD",
        help="name, recipe (rollout, source or lookup), latent dimension or -, forecasts of each split in order",
    )


def read_forecasts(args: argparse.Namespace) -> Iterator[tuple[ModelLabel, Dataset, Dataset]]:
    """Label, truth and forecast, split by split; the truth of each split is read once.

    Raises InputError for words that are no forecaster.
    """
    truths = [read_dataset(*pair) for pair in zip(args.truth, args.shapes, strict=True)]
    for words in args.forecaster:
        who, paths = _label_and_paths(words, len(truths))
        for truth, shapes, path in zip(truths, args.shapes, paths, strict=True):
            yield who, truth, read_dataset(path, shapes)


def _label_and_paths(words: list[str], n_splits: int) -> tuple[ModelLabel, list[Path]]:
    if len(words) != 3 + n_splits or words[1] not in _RECIPES:
        raise InputError(f"forecaster: {' '.join(words)!r} is not allowed; give name, recipe, dimension, files")
    name, recipe, dim, *paths = words
    return ModelLabel(name, recipe, None if dim == "-" else int(dim)), [Path(path) for path in paths]
