"""``sedfiber tabulate_checks``: the largest difference of every run from its check."""

import json
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv


def run(checks: list[Path], *, output: Output) -> None:
    """One row for each file of ``check_simulation``, sorted by (ℬ, angle_index)."""
    table = pd.DataFrame([json.loads(path.read_text(encoding="utf-8")) for path in checks])
    write_csv(table.sort_values(["B", "angle_index"]), output)
