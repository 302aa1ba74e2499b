"""``sedfiber show_table``: a CSV table as an HTML page, for the report."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable, write_text
from sedfiber.core.csv_file import read_csv
from sedfiber.figures.html_page import table_page

_MOST_ROWS = 1000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table and the page."""
    parser.add_argument("table", type=Path, help="CSV table to show")
    parser.add_argument("-o", "--output", type=Path, required=True, help="HTML file to write")


def run(args: argparse.Namespace) -> None:
    """Write the page; it says where all rows and digits are."""
    require_writable(args.output)
    note = f"All rows with all digits are in {args.table}."
    title = args.table.stem.replace("_", " ")
    write_text(args.output, table_page(read_csv(args.table), title, note, _MOST_ROWS))
