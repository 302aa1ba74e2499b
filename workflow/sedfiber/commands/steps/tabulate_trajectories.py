"""``sedfiber tabulate_trajectories``: settling time, cost and checks of every run."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.study.aggregation import facts_table, read_runs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """One ``--split LABEL FILE …`` for each split."""
    parser.add_argument(
        "--split", nargs="+", action="append", required=True, metavar="WORD", help="a label, then its files"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Read every file and write one row each."""
    require_writable(args.output)
    parts = [facts_table(read_runs([Path(p) for p in files], label)) for label, *files in args.split]
    write_csv(pd.concat(parts, ignore_index=True), args.output)
