"""``sedfiber benchmark_parts``: the study's scene made of parts, against one kernel written for it alone."""

from collections.abc import Callable

import numpy as np
import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import NumericalError
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene
from sedfiber.study.costs import fused_study
from sedfiber.study.costs.timing import timed_together

BEADS = (31, 201)
BARS = {31: 2.0, 201: 1.3}  # what parts may cost over the single kernel
REPEATS = 50


def run(*, output: Output) -> None:
    """Time right-hand side and Jacobian at each bead count, print and write the ratios."""
    table = pd.DataFrame([row for n in BEADS for row in _rows(n)])
    print(table.to_string(index=False))
    write_csv(table, output)


def _rows(n_beads: int) -> list[dict]:
    scene = Scene(1000, 0.5, n_beads)
    system = assemble(scene)
    y, modulus = _bent_state(system, n_beads), scene.modulus
    pairs: dict[str, tuple[Callable, Callable]] = {
        "right-hand side": (lambda: system.rhs(0.0, y), lambda: fused_study.rhs(y, modulus)),
        "Jacobian": (lambda: system.jacobian(0.0, y), lambda: fused_study.jacobian(y, modulus)),
    }
    pairs["both"] = (lambda: _both(pairs, 0), lambda: _both(pairs, 1))
    rows = []
    for what, calls in pairs.items():
        if what != "both":
            _require_equal(what, *(call() for call in calls))
        parts, fused = timed_together(list(calls), REPEATS)
        rows.append(
            {
                "n_beads": n_beads,
                "what": what,
                "parts_us": 1e6 * parts.least,
                "parts_spread_us": 1e6 * parts.spread,
                "fused_us": 1e6 * fused.least,
                "fused_spread_us": 1e6 * fused.spread,
                "ratio": parts.least / fused.least,
                "ratio_of_medians": parts.median / fused.median,
                "bar": BARS[n_beads],
            }
        )
    return rows


def _both(pairs: dict, side: int) -> None:
    pairs["right-hand side"][side]()
    pairs["Jacobian"][side]()


def _bent_state(system: System, n_beads: int) -> np.ndarray:
    """A state along the way: an arc through a radian, bonds a little stretched."""
    angle = np.linspace(-0.5, 0.5, n_beads - 1)
    bonds = 2.001 * np.column_stack([np.cos(angle), np.sin(angle)])
    return system.to_state(np.vstack([np.zeros(2), np.cumsum(bonds, axis=0)]))


def _require_equal(what: str, parts: np.ndarray, fused: np.ndarray) -> None:
    """A yardstick that computes something else measures nothing."""
    difference = np.abs(parts - fused).max() / np.abs(fused).max()
    if not difference < 1e-11:
        raise NumericalError(f"benchmark: {what} of the single kernel differs by {difference:.3g}; mend fused_study.py")
