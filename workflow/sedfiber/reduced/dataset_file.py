"""The table of a data set: every sample of many trajectories, with its keys and split."""

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from sedfiber.core.array_types import History, Times
from sedfiber.core.atomic_file import replaced_when_done
from sedfiber.core.parquet_file import WRITING, coordinate_columns


class Labelled(Protocol):
    """One trajectory with its keys; true and forecast ones alike."""

    split: str
    B: float
    angle_index: int
    theta0: float
    t: Times
    positions: History


def write_dataset(trajectories: Sequence[Labelled], path: Path) -> None:
    """Write ``split, B, angle_index, theta0, t, x0, y0, z0, …``, one row per sample."""
    lengths = [len(trajectory.t) for trajectory in trajectories]

    def repeated(key: str) -> np.ndarray:
        return np.repeat([getattr(trajectory, key) for trajectory in trajectories], lengths)

    columns = {
        "split": pa.array(repeated("split").tolist()),
        "B": pa.array(repeated("B")),
        "angle_index": pa.array(repeated("angle_index"), pa.int32()),
        "theta0": pa.array(repeated("theta0")),
        "t": pa.array(np.concatenate([trajectory.t for trajectory in trajectories])),
    }
    positions = np.concatenate([trajectory.positions for trajectory in trajectories])
    columns |= {name: pa.array(values) for name, values in coordinate_columns(positions).items()}
    with replaced_when_done(path) as partial:
        pq.write_table(pa.table(columns), partial, **WRITING)
