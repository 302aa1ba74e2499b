"""``sedfiber measure_trajectories``: error and time of many falls of the study with the default integrator."""

import argparse
from collections.abc import Mapping, Sequence
from itertools import product

import pandas as pd

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.commands.steps._tolerances import tolerance_ladder
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index as index_of
from sedfiber.study.costs.trajectories import TOLERANCES, measure_trajectories


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Grids of falls, one for each split, and the tolerances."""
    add_settings_and_output(parser, "CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure every fall at each tolerance and write a row each."""
    asked = made_from(args.settings, _asked)
    require_writable(args.output)
    table = pd.DataFrame(measure_trajectories(*asked))
    print(table.groupby("tolerance")[["error", "seconds_least", "rhs_units", "simulate_seconds"]].describe().T)
    write_csv(table, args.output)


def _asked(
    splits: Sequence[Mapping], n_beads: int = Scene.n_beads, tolerances: Sequence[float] = TOLERANCES
) -> tuple[list[tuple[float, int]], list[float], int]:
    """Every fall of each split, the tolerances (relative, and absolute in a) and the number of beads."""
    ladder = tolerance_ladder("tolerances", tolerances, 1e-10)  # the error is measured against a hundredth of it
    runs = [run for split in splits for run in made_from(split, _runs, "splits")]
    return runs, ladder, Scene(runs[0][0], 0.0, n_beads).n_beads


def _runs(B: Sequence[float], angle_index: Sequence[int]) -> list[tuple[float, int]]:
    return [(positive_number("B", one), index_of(k)) for one, k in product(B, angle_index)]
