"""``sedfiber compare``: E(t) of one trajectory against another."""

import argparse
import math
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.simulation.trajectory_file import read_trajectory
from sedfiber.study.comparison import Comparison, compare, summary


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare both trajectories and the file for E(t)."""
    parser.add_argument("truth", type=Path, help="trajectory that is taken for true")
    parser.add_argument("other", type=Path, help="trajectory that is compared with it, such as a forecast")
    parser.add_argument(
        "-o", "--output", type=Path, help="CSV file with t, E, E_shape and E_pos, or a picture, .png or .svg (none)"
    )


def run(args: argparse.Namespace) -> None:
    """Compare, print a few lines, and write or draw E(t) with ``--output``."""
    if args.output is not None:
        require_writable(args.output)
    truth, other = read_trajectory(args.truth), read_trajectory(args.other)
    compared = compare(truth, other)
    for line in _lines(truth, other, compared):
        print(line)
    if args.output is not None:
        write = _draw if args.output.suffix in (".png", ".svg") else _write
        write(compared, args)


def _write(compared: Comparison, args: argparse.Namespace) -> None:
    error = compared.error
    columns = {"t": compared.t, "E": error.total, "E_shape": error.shape, "E_pos": error.position}
    write_csv(pd.DataFrame(columns), args.output)


def _draw(compared: Comparison, args: argparse.Namespace) -> None:
    from sedfiber.figures.comparison import draw_comparison  # Matplotlib: only for those who ask
    from sedfiber.figures.style import save_picture

    save_picture(lambda: draw_comparison(compared, f"{args.other.name} against {args.truth.name}"), args.output)


def _lines(truth: Trajectory, other: Trajectory, compared: Comparison) -> list[str]:
    span = f"{len(compared.t)} samples from t = {compared.t[0]:g} to {compared.t[-1]:g}"
    how = "; the second resampled at the times of the first" if compared.resampled else ""
    lines = [f"{span}{how}"]
    for key in ("B", "theta0"):
        values = [run.metadata.get("scene", {}).get(key) for run in (truth, other)]
        if values[0] != values[1]:
            lines.append(f"the two are not of one {key}: {values[0]} and {values[1]}")
    for name, facts in summary(compared).items():
        numbers = f"largest {facts['largest']:.3e} at t = {facts['at t']:g}, mean {facts['mean']:.3e}"
        lines.append(f"{name:8}{numbers}, last {facts['last']:.3e}")
    if not math.isnan(compared.lag):
        word = "late" if compared.lag > 0 else "early"
        lines.append(f"at the largest E_shape the second is {word} by {abs(compared.lag):.3g} a/U_s")
    return lines
