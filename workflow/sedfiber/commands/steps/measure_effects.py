"""``sedfiber measure_effects``: cost and influence of every effect on the study's scene."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_of
from sedfiber.study.effects_table import effect_rows

RATIOS = {"rhs_ratio": "rhs_us", "jacobian_ratio": "jacobian_us", "run_ratio": "run_s"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The scene that is changed, and the table to write."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    parser.add_argument("--angle-index", required=True, help="k in θ0 = k π/48")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--hydrodynamics", default=Scene.hydrodynamics, help=f"as of simulate ({Scene.hydrodynamics})")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure one change after the other; ratios are to the first row, the scene as it is."""
    require_writable(args.output)
    scene = Scene(args.B, angle_of(args.angle_index), args.n_beads, hydrodynamics=args.hydrodynamics)
    rows = []
    for row in effect_rows(scene):
        rows.append(row)
        print(f"{row['effect']}: {row['status']} {row['reason']}".rstrip(), flush=True)
    table = pd.DataFrame(rows)
    for ratio, column in RATIOS.items():
        table.insert(table.columns.get_loc(column) + 1, ratio, table[column] / table[column].iloc[0])
    write_csv(table, args.output)
