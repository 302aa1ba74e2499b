"""``sedfiber tabulate_key_numbers``: this run, the paper's claim and the target, number by number."""

from dataclasses import fields
from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.core.errors import InputError
from sedfiber.study.key_numbers import StudyTables, key_numbers

_TABLES = [table.name for table in fields(StudyTables)]


def run(tables: list[Path], *, output: Output, model: str, variant: str, angle_index: int) -> None:
    """Read the tables, in the order of StudyTables, and write one row a number.

    ``model`` is the forecast model as the tables name it; ``angle_index`` is k of the falls whose regimes count.
    """
    if len(tables) != len(_TABLES):
        raise InputError(f"tables: {len(tables)} files are not allowed; give {', '.join(_TABLES)}")
    write_csv(key_numbers(StudyTables(*map(read_csv, tables)), model, variant, angle_index), output)
