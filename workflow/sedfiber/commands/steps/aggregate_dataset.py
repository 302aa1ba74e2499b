"""``sedfiber aggregate_dataset``: the trajectories of one split as one Parquet file."""

from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.study.aggregation import read_runs


def run(trajectories: list[Path], *, output: Output, split: str) -> None:
    """Read trajectory files, sort, write with the label ``split``."""
    write_dataset(read_runs(trajectories, split), output)
