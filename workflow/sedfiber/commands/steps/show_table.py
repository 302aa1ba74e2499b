"""``sedfiber show_table``: a CSV table as an HTML page, for the report."""

from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.core.atomic_file import write_text
from sedfiber.core.csv_file import read_csv
from sedfiber.figures.html_page import table_page

_MOST_ROWS = 1000


def run(table: Path, *, output: Output) -> None:
    """Write the page; it says where all rows and digits are."""
    note = f"All rows with all digits are in {table}."
    write_text(output, table_page(read_csv(table), table.stem.replace("_", " "), note, _MOST_ROWS))
