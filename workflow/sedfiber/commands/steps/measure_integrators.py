"""``sedfiber measure_integrators``: error and time of every integrator over one fall of the study."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import number_within, positive_number
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index
from sedfiber.study.costs.fall_problem import COUNTED
from sedfiber.study.costs.integrators import LIMIT, SOURCE_LIMIT, TOLERANCES, measure_integrators


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The fall, the ladder of tolerances, and how long a run may take."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    parser.add_argument("--angle-index", required=True, help="k in θ0 = k π/48")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument(
        "--tolerances", nargs="+", default=TOLERANCES, help="relative, and absolute in a (1e-2, 1e-3, … 1e-10)"
    )
    parser.add_argument("--limit", default=LIMIT, help=f"longest run that is not left out, s ({LIMIT:g})")
    parser.add_argument(
        "--source-limit", default=SOURCE_LIMIT, help=f"the source's set-up stops after this, s ({SOURCE_LIMIT:g})"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure, print the rows in short and write them."""
    allowed = "numbers from 1e-12 to 0.1"
    tolerances = tuple(number_within("tolerances", value, 1e-12, 0.1, allowed) for value in args.tolerances)
    limits = positive_number("limit", args.limit), positive_number("source_limit", args.source_limit)
    scene = Scene(args.B, 0.0, args.n_beads)
    index = angle_index(args.angle_index)
    require_writable(args.output)
    table = pd.DataFrame(measure_integrators(scene.B, index, tolerances, *limits, scene.n_beads))
    table[COUNTED] = table[COUNTED].astype("Int64")  # whole numbers, where there are any
    print(table[["method", "jacobian", "tolerance", "error", "seconds_least", "rhs", "status"]].to_string(index=False))
    write_csv(table, args.output)
