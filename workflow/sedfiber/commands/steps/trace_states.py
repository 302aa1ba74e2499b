"""``sedfiber trace_states``: all steady states against ℬ, their growth rates, and where they gain or lose stability."""

import numpy as np
import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.core.validation import positive_number, whole_number
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.branches import Section, Vertical, trace_sections
from sedfiber.simulation.equilibria.states import (
    MEANINGFUL,
    THRESHOLD_COLUMNS,
    disagreement,
    state_rows,
    threshold_rows,
)


def run(
    *,
    thresholds: Output,
    output: Output,
    B_min: float,
    B_max: float,
    per_decade: int,
    n_beads: int,
    hydrodynamics: str,
) -> None:
    """Trace, measure, print the thresholds and how well the measured rates agree; a row for each state."""
    grid = _grid(B_min, B_max, per_decade)
    scene, ends = Scene(grid[0], 0.0, n_beads, hydrodynamics=hydrodynamics), (grid[0], grid[-1])
    sections, remark = trace_sections(scene, *ends)
    branches: list[Section | Vertical] = [*sections, Vertical(scene, grid)]
    rows = [row for branch in branches for row in state_rows(branch, grid, *ends)]
    changes = pd.DataFrame(threshold_rows(branches, *ends), columns=THRESHOLD_COLUMNS)
    _report(changes, remark, *disagreement(rows))
    write_csv(pd.DataFrame(rows), output)
    write_csv(changes, thresholds)


def _grid(B_min: float, B_max: float, per_decade: int) -> list[float]:
    """Values of ℬ even in its logarithm, both ends included exactly."""
    low, high = positive_number("B_min", B_min), positive_number("B_max", B_max)
    per_decade = whole_number("per_decade", per_decade, "a whole number from 1 to 1000", least=1, most=1000)
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
