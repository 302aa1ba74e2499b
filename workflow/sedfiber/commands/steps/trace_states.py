"""``sedfiber trace_states``: all steady states against ℬ, their growth rates, and where they gain or lose stability."""

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.core.validation import positive_number, whole_number
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.branches import Vertical, trace_sections
from sedfiber.simulation.equilibria.states import (
    MEANINGFUL,
    THRESHOLD_COLUMNS,
    disagreement,
    state_rows,
    threshold_rows,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which ℬ, which fiber, and the two tables to write."""
    parser.add_argument("--B-min", default=10, help="least elasto-gravitational number (10)")
    parser.add_argument("--B-max", default=100000, help="largest elasto-gravitational number (100000)")
    parser.add_argument("--per-decade", default=12, help="states of each branch per factor of ten in ℬ (12)")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--hydrodynamics", default=Scene.hydrodynamics, help=f"as of simulate ({Scene.hydrodynamics})")
    parser.add_argument("--thresholds", type=Path, required=True, help="CSV file for the thresholds")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write, a row for each state")


def run(args: argparse.Namespace) -> None:
    """Trace, measure, print the thresholds and how well the measured rates agree."""
    for path in (args.output, args.thresholds):
        require_writable(path)
    grid = _grid(args)
    ends = float(grid[0]), float(grid[-1])
    scene = Scene(ends[0], 0.0, args.n_beads, hydrodynamics=args.hydrodynamics)
    sections, remark = trace_sections(scene, *ends)
    branches = [*sections, Vertical(scene, grid)]
    rows = [row for branch in branches for row in state_rows(branch, grid, *ends)]
    thresholds = pd.DataFrame(threshold_rows(branches, *ends), columns=THRESHOLD_COLUMNS)
    _report(thresholds, remark, *disagreement(rows))
    write_csv(pd.DataFrame(rows), args.output)
    write_csv(thresholds, args.thresholds)


def _grid(args: argparse.Namespace) -> list[float]:
    """Values of ℬ even in its logarithm, both ends included exactly."""
    low, high = positive_number("B_min", args.B_min), positive_number("B_max", args.B_max)
    per_decade = whole_number("per_decade", args.per_decade, "a whole number from 1 to 1000", least=1, most=1000)
    if high <= low:
        raise InputError(f"B_max: {high:g} is not allowed; give a number above B_min={low:g}")
    return [float(B) for B in np.geomspace(low, high, max(round(per_decade * np.log10(high / low)), 1) + 1)]


def _report(thresholds: pd.DataFrame, remark: str, largest: float, compared: int, left_out: int) -> None:
    words = thresholds.to_string(index=False, float_format="{:.6g}".format, na_rep="-")
    print("no thresholds between these ℬ" if thresholds.empty else words)
    if remark:
        print(remark)
    print(f"largest disagreement of a measured with a predicted rate: {largest:.1e} of it")
    print(f"rates compared: {compared}; below {MEANINGFUL:g} U_s/a, where a ratio says nothing: {left_out}")
