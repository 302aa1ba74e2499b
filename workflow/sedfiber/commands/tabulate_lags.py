"""``sedfiber tabulate_lags``: by how much time each forecast is late, and what error is left without that."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.atomic_file import require_writable
from sedfiber.commands._forecasters import add_forecaster_arguments, read_forecasts
from sedfiber.learning.lag import lag_rows
from sedfiber.tables import write_csv


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
