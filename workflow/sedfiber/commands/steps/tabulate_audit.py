"""``sedfiber tabulate_audit``: what each run left out, and whether it mattered."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.simulation.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Runs, in the order of the table."""
    parser.add_argument("trajectories", nargs="+", type=Path, help="trajectory files")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """One row for each run and effect that it left out."""
    require_writable(args.output)
    rows = [row for path in args.trajectories for row in _rows(path)]
    write_csv(pd.DataFrame(rows, columns=["run", "B", "theta0", "effect", "matters", "number", "words"]), args.output)


def _rows(path: Path) -> list[dict]:
    facts = read_trajectory(path).metadata
    if "audit" not in facts:
        raise InputError(f"input: {str(path)!r} holds no audit; it is not a simulation of this version")
    what = {"run": path.stem, "B": facts["B"], "theta0": facts["scene"]["theta0"]}
    return [what | verdict for verdict in facts["audit"]]
