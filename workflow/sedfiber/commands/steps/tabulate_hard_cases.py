"""``sedfiber tabulate_hard_cases``: all hard cases in one table, the failing ones among them."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The cases' own tables, in the order of the result."""
    parser.add_argument("cases", nargs="+", type=Path, help="CSV files of single cases")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Put the tables below each other and print what is wrong, if anything is."""
    require_writable(args.output)
    table = pd.concat([pd.read_csv(path) for path in args.cases], ignore_index=True)
    wrong = table[table["verdict"] == "wrong"]
    print(f"{table['case'].nunique()} cases, {len(table)} measurements, {len(wrong)} wrong")
    for _, row in wrong.iterrows():
        print(f"wrong: {row['case']}: {row['measured']}: {row['value']:.3g}, bound {row['bound']:.3g}")
    write_csv(table, args.output)
