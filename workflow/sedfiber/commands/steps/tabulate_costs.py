"""``sedfiber tabulate_costs``: the same measurement of several cases as one table."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import read_csv, write_csv


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The cases' own tables, in the order of the result."""
    parser.add_argument("cases", nargs="+", type=Path, help="CSV files of single cases")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Put the tables below each other."""
    require_writable(args.output)
    write_csv(pd.concat([read_csv(path) for path in args.cases], ignore_index=True), args.output)
