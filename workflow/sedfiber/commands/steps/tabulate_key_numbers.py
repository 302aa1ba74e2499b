"""``sedfiber tabulate_key_numbers``: this run, the source's claim and the bar, number by number."""

import argparse
from dataclasses import fields
from pathlib import Path

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.study.key_numbers import StudyTables, key_numbers

_TABLES = [table.name for table in fields(StudyTables)]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The tables by name, the forecast model, and the angle whose regimes are named."""
    parser.add_argument("tables", nargs=len(_TABLES), type=Path, help=f"CSV files of {', '.join(_TABLES)}")
    add_settings_and_output(parser, "CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Read the tables and write one row a number."""
    require_writable(args.output)
    asked = made_from(args.settings, _asked)
    write_csv(key_numbers(StudyTables(*map(read_csv, args.tables)), *asked), args.output)


def _asked(model: str, variant: str, angle_index: int) -> tuple[str, str, int]:
    """The forecast model as named in the tables, its variant, and k in θ₀ = kπ/48 of the falls whose regimes count."""
    return model, variant, angle_index
