"""``sedfiber measure_trajectories``: error and time of many falls of the study with the default integrator."""

from collections.abc import Mapping, Sequence
from itertools import product

import pandas as pd

from sedfiber.commands.steps._step import Output, made_from
from sedfiber.commands.steps._tolerances import tolerance_ladder
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index as index_of
from sedfiber.study.costs.trajectories import TOLERANCES, measure_trajectories


def run(
    *,
    output: Output,
    splits: Sequence[Mapping],
    n_beads: int = Scene.n_beads,
    tolerances: Sequence[float] = TOLERANCES,  # relative, and absolute in a
) -> None:
    """Measure every fall of each split's grid at each tolerance and write a row each."""
    ladder = tolerance_ladder("tolerances", tolerances, 1e-10)  # the error is measured against a hundredth of it
    runs = [run for split in splits for run in made_from(split, _runs, "splits")]
    table = pd.DataFrame(measure_trajectories(runs, ladder, Scene(runs[0][0], 0.0, n_beads).n_beads))
    print(table.groupby("tolerance")[["error", "seconds_least", "rhs_units", "simulate_seconds"]].describe().T)
    write_csv(table, output)


def _runs(B: Sequence[float], angle_index: Sequence[int]) -> list[tuple[float, int]]:
    return [(positive_number("B", one), index_of(k)) for one, k in product(B, angle_index)]
