"""``sedfiber measure_trajectories``: error and time of many falls of the study with the default integrator."""

import argparse
from itertools import product
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.core.validation import number_within, positive_number
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index
from sedfiber.study.costs.trajectories import TOLERANCES, measure_trajectories


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Grids of falls, one for each split, and the tolerances."""
    parser.add_argument(
        "--B", nargs="+", action="append", required=True, help="elasto-gravitational numbers; once for each split"
    )
    parser.add_argument(
        "--angle-index", nargs="+", action="append", required=True, help="k in θ0 = k π/48, of the same split"
    )
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    listed = ", ".join(f"{tolerance:g}" for tolerance in TOLERANCES)
    parser.add_argument("--tolerances", nargs="+", default=TOLERANCES, help=f"relative, and absolute in a ({listed})")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every fall at each tolerance and write a row each."""
    allowed = "numbers from 1e-10 to 0.1"  # the error is measured against a hundredth of it
    tolerances = [number_within("tolerances", value, 1e-10, 0.1, allowed) for value in args.tolerances]
    runs = _runs(args.B, args.angle_index)
    n_beads = Scene(runs[0][0], 0.0, args.n_beads).n_beads
    require_writable(args.output)
    table = pd.DataFrame(measure_trajectories(runs, tolerances, n_beads))
    print(table.groupby("tolerance")[["error", "seconds_least", "rhs_units", "simulate_seconds"]].describe().T)
    write_csv(table, args.output)


def _runs(B: list[list[str]], indices: list[list[str]]) -> list[tuple[float, int]]:
    """Every pair of each split."""
    if len(B) != len(indices):
        raise InputError(
            f"angle_index: {len(indices)} lists for {len(B)} of B are not allowed; give one for each split"
        )
    splits = zip(B, indices, strict=True)
    return [(positive_number("B", one), angle_index(k)) for numbers, ks in splits for one, k in product(numbers, ks)]
