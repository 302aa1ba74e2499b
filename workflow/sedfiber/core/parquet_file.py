"""Tables of numbers as Parquet: one column a coordinate, facts as JSON under the key ``sedfiber``."""

import json
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from sedfiber.core.array_types import History, Positions, Times
from sedfiber.core.atomic_file import replaced_when_done
from sedfiber.core.errors import InputError

METADATA_KEY = b"sedfiber"
WRITING = {"compression": "zstd", "write_page_checksum": True}  # a flipped bit is found on reading


def coordinate_names(n_beads: int) -> list[str]:
    """``x0, y0, z0, x1, …``: the column of each coordinate, bead by bead."""
    return [f"{axis}{bead}" for bead in range(n_beads) for axis in "xyz"]


def bead_count(names: list[str]) -> int:
    """Number of beads among column names; 0 when the coordinates are not complete."""
    n_beads = sum(name.startswith("x") and name[1:].isdigit() for name in names)
    return n_beads if set(coordinate_names(n_beads)) <= set(names) else 0


def write_table(path: Path, columns: dict[str, np.ndarray], metadata: dict) -> None:
    """Write named columns with JSON metadata; the same input gives the same bytes."""
    facts = json.dumps(metadata, sort_keys=True, allow_nan=False)
    arrays = [_arrow_array(values) for values in columns.values()]
    table = pa.Table.from_arrays(arrays, names=list(columns), metadata={METADATA_KEY: facts.encode()})
    with replaced_when_done(path) as partial:
        pq.write_table(table, partial, **WRITING)


def _arrow_array(values: np.ndarray) -> pa.Array:
    """Wrap a float column without ``pa.array``, which would import pandas."""
    buffer = pa.py_buffer(np.ascontiguousarray(values, dtype=np.float64))
    return pa.Array.from_buffers(pa.float64(), len(values), [None, buffer])


def read_table(path: Path) -> tuple[pa.Table, dict]:
    """The table and its metadata; raises InputError for anything that is not such a file."""
    if path.is_dir():
        raise InputError(f"input: {str(path)!r} is a folder; give the path of a file")
    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as file:  # pq.read_table would import pandas
            table = file.read()
        facts = json.loads((table.schema.metadata or {})[METADATA_KEY])
    except FileNotFoundError:
        raise InputError(f"input: {str(path)!r} does not exist") from None
    except KeyError:
        raise InputError(f"input: {str(path)!r} was not written by sedfiber (no metadata)") from None
    except (pa.ArrowException, OSError, ValueError):
        raise InputError(f"input: {str(path)!r} is not a readable Parquet file (damaged or truncated?)") from None
    return table, facts


def coordinate_columns(positions: Positions) -> dict[str, np.ndarray]:
    """Positions (T, N, 3) as one contiguous column per coordinate."""
    flat = np.ascontiguousarray(positions.reshape(len(positions), -1).T)
    return dict(zip(coordinate_names(positions.shape[1]), flat, strict=True))


def column_values(table: pa.Table, name: str) -> np.ndarray:
    """The numbers of a column without nulls (rows,), without Arrow's ``to_numpy``, which would import pandas."""
    return np.concatenate([np.from_dlpack(chunk) for chunk in table.column(name).chunks])


def positions_of(table: pa.Table) -> Positions:
    """Positions (T, N, 3) of a table with coordinate columns."""
    names = coordinate_names(bead_count(table.column_names))
    flat = np.array([column_values(table, name) for name in names])
    return np.ascontiguousarray(flat.T).reshape(table.num_rows, -1, 3)


def read_samples(path: Path) -> tuple[Times, History, dict]:
    """Times (T,), positions (T, N, 3) and metadata; raises InputError for a file that does not hold these."""
    table, metadata = read_table(path)
    if not _has_samples(table):
        raise InputError(f"input: {str(path)!r} is not a trajectory (numbers in t, x0, y0, z0, … expected)")
    return column_values(table, "t"), positions_of(table), metadata


def _has_samples(table: pa.Table) -> bool:
    names = ["t", *coordinate_names(bead_count(table.column_names))]
    if len(names) == 1 or "t" not in table.column_names or table.num_rows == 0:
        return False
    return all(table.column(name).type == pa.float64() and table.column(name).null_count == 0 for name in names)
