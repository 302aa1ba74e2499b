"""``sedfiber forecast``: forecast one fiber, or every row of a table, with a trained model.

The way to one forecast imports nothing that is slow to import: see `sedfiber.reduced.plain`.
"""

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from sedfiber.core.atomic_file import require_folder, require_parquet
from sedfiber.core.errors import InputError, SedfiberError
from sedfiber.core.validation import positive_number
from sedfiber.reduced.model_folder import SHIPPED
from sedfiber.reduced.strictness import refusal, warning_line
from sedfiber.scene.scene import Scene
from sedfiber.simulation.trajectory_file import write_trajectory

if TYPE_CHECKING:
    from sedfiber.reduced.forecaster import Forecaster
    from sedfiber.reduced.start_table import TableStart


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    parser.add_argument(
        "starts",
        nargs="?",
        type=Path,
        help="CSV or Parquet with a row for each fiber: B, theta0 and, if needed, shape (a file, looked for beside the "
        "table), name",
    )
    parser.add_argument("--B", help="elasto-gravitational number")
    parser.add_argument("--theta0", help="initial inclination to the x-axis, radians")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, help="Parquet file to write; a folder for the files of a table"
    )
    parser.add_argument("--model", type=Path, default=SHIPPED, help="model folder (the model that comes with sedfiber)")
    parser.add_argument(
        "--t-end", help="end of the forecast, a/U_s: its last sample is at or before it (when the fiber has settled)"
    )
    parser.add_argument("--interval", default=0.5, help="sample spacing, a/U_s (0.5)")
    parser.add_argument("--shape", type=Path, help="start shape, turned by theta0: .csv, .npy, .parquet (straight)")
    parser.add_argument("--strict", action="store_true", help="refuse what would only be warned of")


def run(args: argparse.Namespace) -> None:
    """Validate, forecast, warn of what is not like the training, write."""
    interval = positive_number("interval", args.interval)
    t_end = None if args.t_end is None else positive_number("t_end", args.t_end)
    if args.starts is None:
        _run_one(args, interval, t_end)
    else:
        _run_table(args, interval, t_end)


def _run_one(args: argparse.Namespace, interval: float, t_end: float | None) -> None:
    for key in ("B", "theta0"):
        if getattr(args, key) is None:
            raise InputError(f"{key}: missing; give --{key}, or a table of starts")
    scene = Scene(args.B, args.theta0)
    require_parquet(args.output)
    shape = None if args.shape is None else {"file": args.shape}
    trajectory = _model(args).settle(scene.B, scene.theta0, interval, t_end, shape)
    words = warning_line(trajectory, args.strict)
    if words:
        _warn(words)
    write_trajectory(trajectory, args.output)


def _run_table(args: argparse.Namespace, interval: float, t_end: float | None) -> None:
    """Forecast all rows of a table. No file is written before all rows are valid."""
    from sedfiber.core.progress_bar import with_progress
    from sedfiber.reduced.start_table import read_starts

    for key in ("B", "theta0", "shape"):
        if getattr(args, key) is not None:
            raise InputError(f"{key}: given twice; leave out --{key}, it is a column of {args.starts.name}")
    if args.output.suffix in (".parquet", ".csv"):
        raise InputError(f"output: {str(args.output)!r} looks like a file; a table gets a file a row, give a folder")
    starts, model = read_starts(args.starts), _model(args)
    for start in with_progress(starts):
        with _at(start.place):
            words = "; ".join(model.warnings(start.B, start.theta0, _shape(start)))
        if words and args.strict:
            raise refusal(f"{start.place}: {words}")
    require_folder(args.output)
    doubts = [_write(args, model, start, interval, t_end) for start in with_progress(starts)]
    if any(doubts):
        count = f"{sum(map(bool, doubts))} of {len(starts)} forecasts are not to be relied on, as their files say"
        _warn(f"{count}; the first: {next(filter(None, doubts))}")


def _write(
    args: argparse.Namespace, model: "Forecaster", start: "TableStart", interval: float, t_end: float | None
) -> str:
    """Forecast a row and write its file; its warnings."""
    with _at(start.place):
        trajectory = model.settle(start.B, start.theta0, interval, t_end, _shape(start))
    words = warning_line(trajectory, args.strict, f"{start.place}: ")
    write_trajectory(trajectory, args.output / f"{start.name}.parquet")
    return words


@contextmanager
def _at(place: str) -> Iterator[None]:
    """Says of what row an error is."""
    try:
        yield
    except SedfiberError as error:
        raise type(error)(f"{place}: {error}") from None


def _shape(start: "TableStart") -> dict | None:
    return None if start.shape is None else {"file": start.shape}


def _model(args: argparse.Namespace) -> "Forecaster":
    from sedfiber.reduced.forecaster import load_plain_model  # bad input fails before its imports

    return load_plain_model(args.model)


def _warn(words: str) -> None:
    print(f"sedfiber forecast: warning: {words}", file=sys.stderr)
