"""``sedfiber aggregate_dataset``: the trajectories of one split as one Parquet file."""

import argparse
from pathlib import Path

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.study.aggregation import read_runs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which files, and the label they get."""
    parser.add_argument("trajectories", nargs="+", type=Path, help="trajectory files")
    add_settings_and_output(parser, "Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Read, sort and write."""
    require_writable(args.output)
    write_dataset(read_runs(args.trajectories, made_from(args.settings, _label)), args.output)


def _label(split: str) -> str:
    return split
