"""``sedfiber tabulate_lags``: by how much time each forecast is late, and what error is left without that."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._forecasters import add_forecaster_arguments, read_forecasts
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.study.lag import lag_rows


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True splits, forecasts of each by each forecaster, and the table."""
    add_forecaster_arguments(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every forecaster on every split and write the table."""
    require_writable(args.output)
    parts = [lag_rows(who, truth, forecast) for who, truth, forecast in read_forecasts(args)]
    table = pd.concat(parts, ignore_index=True).astype({"latent_dim": "Int64"})  # the lookup has none
    write_csv(table, args.output)
