"""``sedfiber tabulate_forecast_errors``: E(t) of all forecasts of both test sets, as tables."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.atomic_file import require_writable
from sedfiber.errors import InputError
from sedfiber.learning.dataset import Dataset, read_dataset
from sedfiber.learning.error_tables import (
    Forecaster,
    ensemble_rows,
    measure,
    summary_rows,
    trajectory_rows,
)
from sedfiber.tables import write_csv

OUTPUTS = ("forecast_errors", "source_errors", "lookup_errors", "ensemble_errors", "baselines")
_ERRORS_OF = {"rollout": "forecast_errors", "source": "source_errors", "lookup": "lookup_errors"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True splits, forecasts of each by each forecaster, and one file per table."""
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
    for name in OUTPUTS:
        parser.add_argument(f"--{name.replace('_', '-')}", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every forecaster on every split and write the tables."""
    for name in OUTPUTS:
        require_writable(getattr(args, name))
    truths = [read_dataset(*pair) for pair in zip(args.truth, args.shapes, strict=True)]
    tables: dict[str, list[pd.DataFrame]] = {name: [] for name in OUTPUTS}
    for words in args.forecaster:
        who, paths = forecaster_and_files(words, len(truths))
        for truth, shapes, path in zip(truths, args.shapes, paths, strict=True):
            _add(tables, who, truth, read_dataset(path, shapes))
    for name, parts in tables.items():
        table = pd.concat(parts, ignore_index=True).astype({"latent_dim": "Int64"})  # the lookup has none
        write_csv(table, getattr(args, name))


def forecaster_and_files(words: list[str], n_splits: int) -> tuple[Forecaster, list[Path]]:
    if len(words) != 3 + n_splits or words[1] not in _ERRORS_OF:
        raise InputError(f"forecaster: {' '.join(words)!r} is not allowed; give name, recipe, dimension, files")
    name, recipe, dim, *paths = words
    return Forecaster(name, recipe, None if dim == "-" else int(dim)), [Path(path) for path in paths]


def _add(tables: dict[str, list[pd.DataFrame]], who: Forecaster, truth: Dataset, forecast: Dataset) -> None:
    measured = measure(truth, forecast)
    tables[_ERRORS_OF[who.recipe]].append(trajectory_rows(who, measured))
    tables["ensemble_errors"].append(ensemble_rows(who, measured))
    tables["baselines"].append(summary_rows(who, measured))
