"""``sedfiber aggregate_dataset``: the trajectories of one split as one Parquet file."""

import argparse
from pathlib import Path

import pyarrow.parquet as pq

from sedfiber.aggregation import read_all, samples_table
from sedfiber.atomic_file import replaced_when_done, require_writable


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which files, and the label they get."""
    parser.add_argument("trajectories", nargs="+", type=Path, help="trajectory files")
    parser.add_argument("--split", required=True, help="label of the split, such as train, A or B")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Read, sort and write."""
    require_writable(args.output)
    table = samples_table(read_all(args.trajectories), args.split)
    with replaced_when_done(args.output) as partial:
        pq.write_table(table, partial, compression="zstd")
