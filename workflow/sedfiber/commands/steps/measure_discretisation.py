"""``sedfiber measure_discretisation``: what beads and hydrodynamics cost and change over one fall of the study."""

from collections.abc import Sequence

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.scene.scene import Scene
from sedfiber.study.costs.discretisation import BEADS, GROWTH_COLUMNS, cost_growth, measure_discretisation
from sedfiber.study.costs.fall_problem import COUNTED


def run(*, output: Output, growth: Output, n_beads: Sequence[int] = BEADS) -> None:
    """Measure, print in short and write a row for each N, and the exponents in N."""
    if output == growth:
        raise InputError(f"growth: {str(growth)!r} is the output as well; give another path")
    rows = measure_discretisation(sorted({Scene(1.0, 0.0, n).n_beads for n in n_beads}))
    exponents = pd.DataFrame(cost_growth(rows), columns=GROWTH_COLUMNS)
    table = pd.DataFrame(rows)
    counted = [*COUNTED, "repeats"]
    table[counted] = table[counted].astype("Int64")  # whole numbers, where there are any
    print(table[["n_beads", "hydrodynamics", "shape_from_finest_L", "speed", "seconds_least", "status"]].to_string())
    print(exponents[["hydrodynamics", "quantity", "exponent", "standard_error"]].to_string(index=False))
    write_csv(table, output)
    write_csv(exponents, growth)
