"""``sedfiber tabulate_regimes``: how each fall turns and bends, and which regime that is."""

import argparse
from dataclasses import asdict
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.reduced.dataset import read_dataset
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.regimes import measure_motion


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """One ``--split SAMPLES SHAPES`` for each split."""
    parser.add_argument(
        "--split",
        nargs=2,
        action="append",
        required=True,
        metavar=("SAMPLES", "SHAPES"),
        help="Parquet files of a split's samples and of its steady shapes",
    )
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every trajectory and write one row each; angles in radians, lengths in L."""
    require_writable(args.output)
    rows = [_row(trajectory) for pair in args.split for trajectory in read_dataset(*pair)]
    write_csv(pd.DataFrame(rows), args.output)


def _row(trajectory: Trajectory) -> dict:
    motion = measure_motion(trajectory.positions)
    keys = {"split": trajectory.split, "B": trajectory.B, "angle_index": trajectory.angle_index}
    return keys | asdict(motion) | {"regime": motion.regime}
