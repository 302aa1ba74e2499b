"""Arguments of the steps that judge several forecasters on several test splits."""

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path

from sedfiber.commands.steps._data import add_splits, read_splits
from sedfiber.commands.steps._settings import made_from
from sedfiber.core.errors import InputError
from sedfiber.core.validation import one_of
from sedfiber.reduced.dataset import Dataset, read_dataset
from sedfiber.study.error_tables import RECIPES, ModelLabel


def add_forecaster_arguments(parser: argparse.ArgumentParser) -> None:
    """True splits, forecasts of each by each forecaster, and who the forecasters are."""
    add_splits(parser, "--truth", "test splits")
    parser.add_argument(
        "--forecasts", nargs="+", type=Path, required=True, help="forecasts of each split in order, by each forecaster"
    )
    parser.add_argument(
        "--settings", required=True, help="JSON object: forecasters, a list of [name, recipe, latent dimension or null]"
    )


def read_forecasts(args: argparse.Namespace) -> Iterator[tuple[ModelLabel, Dataset, Dataset]]:
    """Label, truth and forecast, split by split; the truth of each split is read once.

    Raises InputError for settings that name no forecasters, and for another number of forecasts.
    """
    who, truths, shapes = made_from(args.settings, _forecasters), read_splits(args.truth), args.truth[1::2]
    if len(args.forecasts) != len(who) * len(truths):
        raise InputError(f"forecasts: {len(args.forecasts)} files are not allowed; give {len(who) * len(truths)}")
    paths = iter(args.forecasts)
    for one in who:
        for truth, terminal in zip(truths, shapes, strict=True):
            yield one, truth, read_dataset(next(paths), terminal)


def _forecasters(forecasters: Sequence[Sequence]) -> list[ModelLabel]:
    return [ModelLabel(name, one_of("recipe", recipe, RECIPES), dim) for name, recipe, dim in forecasters]
