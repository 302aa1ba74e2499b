"""``sedfiber measure_integrators``: error and time of every integrator over one fall of the study."""

from collections.abc import Sequence

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.commands.steps._tolerances import tolerance_ladder
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index as index_of
from sedfiber.study.costs.fall_problem import COUNTED
from sedfiber.study.costs.integrators import LIMIT, SOURCE_LIMIT, TOLERANCES, measure_integrators


def run(
    *,
    output: Output,
    B: float,
    angle_index: int,
    n_beads: int = Scene.n_beads,
    tolerances: Sequence[float] = TOLERANCES,  # relative, and absolute in a
    limit: float = LIMIT,  # s, longest run that is not left out
    source_limit: float = SOURCE_LIMIT,  # s, after this the paper's set-up stops
) -> None:
    """Measure one fall by each integrator, print the rows in short and write them."""
    scene, ladder = Scene(B, 0.0, n_beads), tuple(tolerance_ladder("tolerances", tolerances))
    limits = positive_number("limit", limit), positive_number("source_limit", source_limit)
    rows = measure_integrators(scene.B, index_of(angle_index), ladder, *limits, scene.n_beads)
    table = pd.DataFrame(rows)
    table[COUNTED] = table[COUNTED].astype("Int64")  # whole numbers, where there are any
    print(table[["method", "jacobian", "tolerance", "error", "seconds_least", "rhs", "status"]].to_string(index=False))
    write_csv(table, output)
