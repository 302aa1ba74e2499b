"""``sedfiber aggregate_dataset``: the trajectories of one split as one Parquet file."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.study.aggregation import read_runs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which files, and the label they get."""
    parser.add_argument("trajectories", nargs="+", type=Path, help="trajectory files")
    parser.add_argument("--split", required=True, help="label of the split, such as train, A or B")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Read, sort and write."""
    require_writable(args.output)
    write_dataset(read_runs(args.trajectories, args.split), args.output)
