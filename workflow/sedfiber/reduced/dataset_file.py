"""The table of a data set, or of forecasts of it: every sample of many falls, with the keys of its fall."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from sedfiber.core.atomic_file import replaced_when_done
from sedfiber.core.errors import InputError
from sedfiber.core.parquet_file import WRITING, coordinate_columns, coordinate_names
from sedfiber.simulation.trajectory import Trajectory, fall_keys

if TYPE_CHECKING:
    import pandas as pd  # a forecast does without

KEYS = ("split", "B", "angle_index", "theta0")


def write_dataset(falls: Sequence[Trajectory], path: Path) -> None:
    """Write ``split, B, angle_index, theta0, t, x0, y0, z0, …``, one row per sample."""
    lengths = [len(fall.t) for fall in falls]

    def repeated(key: str) -> np.ndarray:
        return np.repeat([getattr(fall, key) for fall in falls], lengths)

    columns = {
        "split": pa.array(repeated("split").tolist()),
        "B": pa.array(repeated("B")),
        "angle_index": pa.array(repeated("angle_index"), pa.int32()),
        "theta0": pa.array(repeated("theta0")),
        "t": pa.array(np.concatenate([fall.t for fall in falls])),
    }
    positions = np.concatenate([fall.positions for fall in falls])
    columns |= {name: pa.array(values) for name, values in coordinate_columns(positions).items()}
    with replaced_when_done(path) as partial:
        pq.write_table(pa.table(columns), partial, **WRITING)


def read_falls(path: str | Path) -> list[Trajectory]:
    """Every fall of the table, sorted by (ℬ, angle_index).

    Raises InputError when the file is missing, unreadable, empty or lacks a column.
    """
    table = read_frame(path)
    n_beads = sum(name.startswith("x") and name[1:].isdigit() for name in table)
    names = coordinate_names(max(n_beads, 1))
    missing = [name for name in (*KEYS, "t", *names) if name not in table]
    if missing:
        raise InputError(f"input: {str(path)!r} lacks the columns {', '.join(missing)}")
    if table.empty:
        raise InputError(f"input: {str(path)!r} has no rows")
    return [_fall(group, names) for _, group in table.groupby(["B", "angle_index"], sort=True)]


def read_frame(path: str | Path) -> "pd.DataFrame":
    """A Parquet table whose columns may be words; raises InputError for what is none."""
    try:
        return pq.read_table(path, page_checksum_verification=True).to_pandas()
    except (OSError, ValueError, pa.ArrowException) as error:
        raise InputError(f"input: cannot read {str(path)!r} as Parquet ({str(error).splitlines()[0]})") from None


def _fall(group: "pd.DataFrame", names: list[str]) -> Trajectory:
    first = group.iloc[0]
    keys = fall_keys(str(first["split"]), float(first["B"]), int(first["angle_index"]), float(first["theta0"]))
    positions = group[names].to_numpy(dtype=float).reshape(len(group), -1, 3)
    return Trajectory(group["t"].to_numpy(dtype=float), positions, keys)
