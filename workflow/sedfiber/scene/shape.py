"""A start shape as a user gives it: words, rows of numbers, or a file."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.core.errors import InputError
from sedfiber.core.validation import refused

REST = "rest"


def read_shape(value: Any, n_beads: int, dim: int) -> Any:
    """A start shape as the scene keeps it: None, "rest", or N rows of three numbers; raises InputError."""
    if value is None or (isinstance(value, str) and value in ("none", "straight")):
        return None
    if isinstance(value, str) and value == REST:
        return REST
    if isinstance(value, dict) and set(value) == {"file"}:
        return read_shape(_from_file(Path(str(value["file"]))), n_beads, dim)
    allowed = f"straight, rest, {{file: PATH}}, or {n_beads} rows of 2 or 3 finite numbers"
    try:
        x = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise refused("shape", _shown(value), allowed) from None
    if x.ndim == 2 and x.shape[1] in (2, 3) and len(x) != n_beads:
        raise InputError(f"shape: a row count of {len(x)} is not allowed; give {n_beads} rows, one a bead (n_beads)")
    if x.shape not in ((n_beads, 2), (n_beads, 3)):
        raise refused("shape", _shown(value), allowed)
    if not np.isfinite(x).all():
        row = int(np.flatnonzero(~np.isfinite(x).all(axis=1))[0])
        raise InputError(f"shape: row {row + 1}, {x[row].tolist()}, is not allowed; give {allowed}")
    if dim == 2 and x[:, 2:].any():
        raise InputError("shape: leaves the plane z = 0 of a planar scene; give space: volume")
    padded = np.zeros((n_beads, 3))
    padded[:, : x.shape[1]] = x
    return tuple(map(tuple, padded.tolist()))


def _from_file(path: Path) -> Positions:
    """Rows of numbers (.csv, .npy), or the last sample of a trajectory (.parquet)."""
    if path.suffix == ".parquet":
        from sedfiber.core.parquet_file import read_samples  # Arrow: only for those who ask

        try:
            return read_samples(path)[1][-1]
        except InputError as error:
            raise InputError(f"shape.file: {error}") from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # an empty file has no rows, which is said below
            npy = path.suffix == ".npy"
            return np.load(path, allow_pickle=False) if npy else np.loadtxt(path, delimiter=",", ndmin=2)
    except (OSError, ValueError, EOFError) as error:
        why = str(error).splitlines()[0]
        raise InputError(
            f"shape.file: cannot read {str(path)!r} ({why}); give .csv (a row of 2 or 3 numbers for each bead, with "
            "commas and without a header), .npy or a trajectory"
        ) from None


def _shown(value: Any) -> Any:
    """A value as an error shows it: short, on one line."""
    text = " ".join(str(value).split())
    return text if len(text) <= 60 else text[:57] + "…"
