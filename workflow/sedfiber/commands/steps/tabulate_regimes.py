"""``sedfiber tabulate_regimes``: how each fall turns and bends, and which regime that is."""

import argparse
from dataclasses import asdict
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._data import add_splits, read_splits
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.regimes import measure_motion


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The splits and the table."""
    add_splits(parser, "splits", "splits of the data set")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every trajectory and write one row each; angles in radians, lengths in L."""
    require_writable(args.output)
    rows = [_row(trajectory) for split in read_splits(args.splits) for trajectory in split]
    write_csv(pd.DataFrame(rows), args.output)


def _row(trajectory: Trajectory) -> dict:
    motion = measure_motion(trajectory.positions)
    keys = {"split": trajectory.split, "B": trajectory.B, "angle_index": trajectory.angle_index}
    return keys | asdict(motion) | {"regime": motion.regime}
