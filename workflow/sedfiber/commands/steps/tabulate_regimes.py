"""``sedfiber tabulate_regimes``: how each fall turns and bends, and which regime that is."""

from dataclasses import asdict

import pandas as pd

from sedfiber.commands.steps._data import read_splits
from sedfiber.commands.steps._step import Output, Splits
from sedfiber.core.csv_file import write_csv
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.regimes import measure_motion


def run(splits: Splits, *, output: Output) -> None:
    """Measure every trajectory and write one row each; angles in radians, lengths in L."""
    rows = [_row(trajectory) for split in read_splits(splits) for trajectory in split]
    write_csv(pd.DataFrame(rows), output)


def _row(trajectory: Trajectory) -> dict:
    motion = measure_motion(trajectory.positions)
    keys = {"split": trajectory.split, "B": trajectory.B, "angle_index": trajectory.angle_index}
    return keys | asdict(motion) | {"regime": motion.regime}
