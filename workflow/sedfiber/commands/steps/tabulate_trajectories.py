"""``sedfiber tabulate_trajectories``: settling time, cost and checks of every run."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.study.aggregation import facts_table, read_runs


def run(*, output: Output, splits: Mapping[str, Sequence[str]]) -> None:
    """Read the files of each split, given by its label, and write one row each."""
    parts = [facts_table(read_runs([Path(file) for file in files], label)) for label, files in splits.items()]
    write_csv(pd.concat(parts, ignore_index=True), output)
