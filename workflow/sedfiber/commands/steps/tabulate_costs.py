"""``sedfiber tabulate_costs``: the same measurement of several cases as one table."""

from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import read_csv, write_csv


def run(cases: list[Path], *, output: Output) -> None:
    """Put the tables of single cases below each other."""
    write_csv(pd.concat([read_csv(path) for path in cases], ignore_index=True), output)
