"""Trajectories as Parquet: one row per sample, facts as JSON under the key ``sedfiber``."""

from pathlib import Path

import numpy as np

from sedfiber.core.parquet_file import coordinate_columns, read_samples, write_table
from sedfiber.simulation.trajectory import Trajectory


def write_trajectory(trajectory: Trajectory, path: str | Path) -> None:
    """Write ``t`` and all coordinates, metadata included; atomic and byte-identical on rerun."""
    columns = {"t": np.asarray(trajectory.t)} | coordinate_columns(trajectory.positions)
    write_table(Path(path), columns, trajectory.metadata)


def read_trajectory(path: str | Path) -> Trajectory:
    """Read a trajectory; raises InputError when the file is missing, damaged or incomplete."""
    return Trajectory(*read_samples(Path(path)))
