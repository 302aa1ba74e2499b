"""``sedfiber measure_discretisation``: what beads and hydrodynamics cost and change over one fall of the study."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.scene.scene import Scene
from sedfiber.study.costs.discretisation import BEADS, GROWTH_COLUMNS, cost_growth, measure_discretisation
from sedfiber.study.costs.fall_problem import COUNTED


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The ladder of beads, and the two tables to write."""
    add_settings_and_output(parser, "CSV file to write, a row for each N")
    parser.add_argument("--growth", type=Path, required=True, help="CSV file of the exponents in N to write")


def run(args: argparse.Namespace) -> None:
    """Measure, print both tables in short and write them."""
    beads = made_from(args.settings, _beads)
    if args.output == args.growth:
        raise InputError(f"growth: {str(args.growth)!r} is the output as well; give another path")
    for path in (args.output, args.growth):
        require_writable(path)
    rows = measure_discretisation(beads)
    growth = pd.DataFrame(cost_growth(rows), columns=GROWTH_COLUMNS)
    table = pd.DataFrame(rows)
    counted = [*COUNTED, "repeats"]
    table[counted] = table[counted].astype("Int64")  # whole numbers, where there are any
    print(table[["n_beads", "hydrodynamics", "shape_from_finest_L", "speed", "seconds_least", "status"]].to_string())
    print(growth[["hydrodynamics", "quantity", "exponent", "standard_error"]].to_string(index=False))
    write_csv(table, args.output)
    write_csv(growth, args.growth)


def _beads(n_beads: Sequence[int] = BEADS) -> list[int]:
    """The ladder of beads, in order."""
    return sorted({Scene(1.0, 0.0, n).n_beads for n in n_beads})
