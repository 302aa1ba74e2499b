"""``sedfiber tabulate_lags``: by how much time each forecast is late, and what error is left without that."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.atomic_file import require_writable
from sedfiber.commands.tabulate_forecast_errors import forecaster_and_files as forecaster_and_files
from sedfiber.learning.dataset import read_dataset
from sedfiber.learning.lag import lag_rows
from sedfiber.tables import write_csv


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True splits, forecasts of each by each forecaster, and the table."""
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
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every forecaster on every split and write the table."""
    require_writable(args.output)
    truths = [read_dataset(*pair) for pair in zip(args.truth, args.shapes, strict=True)]
    parts: list[pd.DataFrame] = []
    for words in args.forecaster:
        who, paths = forecaster_and_files(words, len(truths))
        for truth, shapes, path in zip(truths, args.shapes, paths, strict=True):
            parts.append(lag_rows(who, truth, read_dataset(path, shapes)))
    table = pd.concat(parts, ignore_index=True).astype({"latent_dim": "Int64"})  # the lookup has none
    write_csv(table, args.output)
