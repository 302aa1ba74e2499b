"""The forecasts of several forecasters on several test splits."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from sedfiber.commands.steps._data import read_splits
from sedfiber.core.errors import InputError
from sedfiber.core.validation import one_of
from sedfiber.reduced.dataset import Dataset, read_dataset
from sedfiber.study.error_tables import RECIPES, ModelLabel


def read_forecasts(
    truth: Sequence[Path], forecasts: Sequence[Path], forecasters: Sequence[Sequence]
) -> Iterator[tuple[ModelLabel, Dataset, Dataset]]:
    """Label, truth and forecast, split by split, of each [name, recipe, latent dimension or null] in turn.

    The truth of each split is read once.  Raises InputError for another number of forecasts.
    """
    who = [ModelLabel(name, one_of("recipe", recipe, RECIPES), dim) for name, recipe, dim in forecasters]
    truths, shapes = read_splits(truth), truth[1::2]
    if len(forecasts) != len(who) * len(truths):
        raise InputError(f"forecasts: {len(forecasts)} files are not allowed; give {len(who) * len(truths)}")
    paths = iter(forecasts)
    for one in who:
        for split, terminal in zip(truths, shapes, strict=True):
            yield one, split, read_dataset(next(paths), terminal)
