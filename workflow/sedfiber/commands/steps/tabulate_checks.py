"""``sedfiber tabulate_checks``: the largest difference of every run from its check."""

import argparse
import json
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What ``check_simulation`` wrote."""
    parser.add_argument("checks", nargs="+", type=Path, help="JSON files of single checks")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """One row per run, sorted by (ℬ, angle_index)."""
    require_writable(args.output)
    table = pd.DataFrame([json.loads(path.read_text(encoding="utf-8")) for path in args.checks])
    write_csv(table.sort_values(["B", "angle_index"]), args.output)
