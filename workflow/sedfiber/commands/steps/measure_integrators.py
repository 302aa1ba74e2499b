"""``sedfiber measure_integrators``: error and time of every integrator over one fall of the study."""

import argparse
from collections.abc import Sequence

import pandas as pd

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.commands.steps._tolerances import tolerance_ladder
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index as index_of
from sedfiber.study.costs.fall_problem import COUNTED
from sedfiber.study.costs.integrators import LIMIT, SOURCE_LIMIT, TOLERANCES, measure_integrators


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The fall, the ladder of tolerances, and how long a run may take."""
    add_settings_and_output(parser, "CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure, print the rows in short and write them."""
    asked = made_from(args.settings, _asked)
    require_writable(args.output)
    table = pd.DataFrame(measure_integrators(*asked))
    table[COUNTED] = table[COUNTED].astype("Int64")  # whole numbers, where there are any
    print(table[["method", "jacobian", "tolerance", "error", "seconds_least", "rhs", "status"]].to_string(index=False))
    write_csv(table, args.output)


def _asked(
    B: float,
    angle_index: int,
    n_beads: int = Scene.n_beads,
    tolerances: Sequence[float] = TOLERANCES,  # relative, and absolute in a
    limit: float = LIMIT,  # s, longest run that is not left out
    source_limit: float = SOURCE_LIMIT,  # s, after this the source's set-up stops
) -> tuple[float, int, tuple[float, ...], float, float, int]:
    scene = Scene(B, 0.0, n_beads)
    ladder = tuple(tolerance_ladder("tolerances", tolerances))
    limits = positive_number("limit", limit), positive_number("source_limit", source_limit)
    return scene.B, index_of(angle_index), ladder, *limits, scene.n_beads
