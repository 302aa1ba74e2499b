"""``sedfiber forecast_by_lookup``: the baseline without a model, splines through the training runs."""

import argparse
from dataclasses import replace
from pathlib import Path

from sedfiber.commands.steps._data import add_split
from sedfiber.core.atomic_file import require_writable
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.study.lookup import LookupTable


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The training split, and the split to look up."""
    add_split(parser, "truth", "the split to look up")
    add_split(parser, "--training", "the training split")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Interpolate at the samples of the true trajectories; same layout as the data set."""
    require_writable(args.output)
    table = LookupTable(read_dataset(*args.training))
    truth = read_dataset(*args.truth)
    forecasts = [replace(one, positions=table.forecast(one.B, one.theta0, one.t)) for one in truth]
    write_dataset(forecasts, args.output)
