"""``sedfiber measure_effects``: cost and influence of every effect on the study's scene."""

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_of
from sedfiber.study.effects_table import effect_rows

RATIOS = {"rhs_ratio": "rhs_us", "jacobian_ratio": "jacobian_us", "run_ratio": "run_s"}


def run(
    *,
    output: Output,
    B: float,
    angle_index: int,
    n_beads: int = Scene.n_beads,
    hydrodynamics: str = Scene.hydrodynamics,
) -> None:
    """Measure one change of the scene after the other; ratios are to the first row, the scene as it is."""
    scene = Scene(B, angle_of(angle_index), n_beads, hydrodynamics=hydrodynamics)
    rows = []
    for row in effect_rows(scene):
        rows.append(row)
        print(f"{row['effect']}: {row['status']} {row['reason']}".rstrip(), flush=True)
    table = pd.DataFrame(rows)
    for ratio, column in RATIOS.items():
        table.insert(table.columns.get_loc(column) + 1, ratio, table[column] / table[column].iloc[0])
    write_csv(table, output)
