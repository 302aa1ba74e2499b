"""A table of starts to forecast: one row a fiber, as CSV or Parquet.

Columns are ``B`` and ``theta0`` (radians), and optionally ``shape`` (a file with the start
shape, its path relative to the table) and ``name`` (of the file to write, without its suffix; where
there is none it is ``B{B}_theta{theta0}``).  An empty cell is as good as none.
"""

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from sedfiber.core.errors import InputError
from sedfiber.core.validation import refused
from sedfiber.scene.scene import Scene

REQUIRED, OPTIONAL = ("B", "theta0"), ("shape", "name")


@dataclass(frozen=True)
class TableStart:
    """One row; ``place`` is how messages call it, such as ``starts.csv, line 3``."""

    place: str
    B: float
    theta0: float
    shape: Path | None
    name: str


def read_starts(path: Path) -> list[TableStart]:
    """Every row of a table; raises InputError with line, column, value and what is allowed."""
    starts = [_start(path, place, row) for place, row in _rows(path)]
    if not starts:
        raise InputError(f"input: {str(path)!r} has no rows; give one for each fiber")
    first: dict[str, str] = {}
    for start in starts:
        if start.name in first:
            other = f"a name of its own: {first[start.name]} has this one, which stands for a file"
            raise InputError(f"{start.place}: {refused('name', start.name, other)}")
        first[start.name] = start.place
    return starts


def _rows(path: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    """Place and cells of every row; empty cells are left out."""
    read = _parquet_rows if path.suffix == ".parquet" else _csv_rows
    try:
        for number, row in read(path):
            yield f"{path.name}, {number}", {key: cell for key, cell in row.items() if cell not in (None, "")}
    except (OSError, ValueError, csv.Error, pa.ArrowException) as error:
        why = getattr(error, "strerror", None) or " ".join(str(error).split())
        raise InputError(f"input: cannot read {str(path)!r} ({why}); give CSV, or Parquet as .parquet") from None


def _csv_rows(path: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    with path.open(encoding="utf-8-sig", newline="") as file:  # spreadsheets begin a file with a mark
        reader = csv.DictReader(file, skipinitialspace=True, strict=True)
        names = [name.strip() for name in reader.fieldnames or []]
        _require_columns(path, names)
        reader.fieldnames = names
        for row in reader:
            place = f"line {reader.line_num}"
            if None in row or None in row.values():
                cells = sum(cell is not None for key, cell in row.items() if key) + len(row.get(None, []))
                wanted = len(names)
                raise InputError(f"{path.name}, {place}: {cells} cells; give {wanted}, as many as there are columns")
            yield place, {key: cell.strip() for key, cell in row.items()}


def _parquet_rows(path: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    with pq.ParquetFile(path, page_checksum_verification=True) as file:
        table = file.read()
    _require_columns(path, table.column_names)
    for number, row in enumerate(table.to_pylist(), start=1):
        yield f"row {number}", row


def _require_columns(path: Path, names: list[str]) -> None:
    missing = [name for name in REQUIRED if name not in names]
    strange = [name for name in names if name not in REQUIRED + OPTIONAL]
    if missing or strange or len(set(names)) < len(names):
        if missing:
            what = f"no column {missing[0]!r} in {', '.join(names)[:60]!r}"
        else:
            what = f"a column {(strange or names)[0]!r} too many"
        raise InputError(f"{path.name}: {what}; give {', '.join(REQUIRED)} and, if needed, {', '.join(OPTIONAL)}")


def _start(path: Path, place: str, row: dict[str, Any]) -> TableStart:
    try:
        scene = Scene(row.get("B", ""), row.get("theta0", ""))
        name = _file_name(str(row.get("name", f"B{_plain(scene.B)}_theta{_plain(scene.theta0)}")))
    except InputError as error:
        raise InputError(f"{place}: {error}") from None
    shape = row.get("shape")
    return TableStart(place, scene.B, scene.theta0, None if shape is None else path.parent / str(shape), name)


def _plain(number: float) -> str:
    """All digits that tell it from another, without a zero behind the point."""
    return repr(number).removesuffix(".0")


def _file_name(name: str) -> str:
    if name.startswith(".") or any(letter in name for letter in "/\\\0") or len(name.encode()) > 200:
        raise refused("name", name, "a file's name without folder and suffix, of 200 letters at most")
    return name
