"""``sedfiber tabulate_key_numbers``: this run, the source's claim and the bar, number by number."""

import argparse
from dataclasses import fields
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.study.key_numbers import StudyTables, key_numbers


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The tables by name, the forecast model, and the angle whose regimes are named."""
    for table in fields(StudyTables):
        parser.add_argument(f"--{table.name}", type=Path, required=True, help=f"{table.name}.csv")
    parser.add_argument("--model", required=True, help="the forecast model, as named in the tables")
    parser.add_argument("--variant", required=True, help="its variant: none, encoder, decoder or double")
    parser.add_argument(
        "--angle-index", type=int, required=True, help="k in θ₀ = kπ/48 of the falls whose regimes count"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Read the tables and write one row a number."""
    require_writable(args.output)
    tables = StudyTables(**{table.name: read_csv(getattr(args, table.name)) for table in fields(StudyTables)})
    write_csv(key_numbers(tables, args.model, args.variant, args.angle_index), args.output)
