"""``sedfiber check_simulation``: one run again with another method and tighter tolerance."""

import argparse
import json
from dataclasses import dataclass
from pathlib import Path

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable, write_text
from sedfiber.core.errors import NumericalError
from sedfiber.core.validation import positive_number
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory_file import read_trajectory


@dataclass(frozen=True)
class Check:
    """The second method, its relative and absolute tolerance, and the largest difference allowed, over L."""

    integrator: str
    tolerance: float
    bound: float


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, the second method, and how far the two may differ."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to check")
    add_settings_and_output(parser, "JSON file to write")


def run(args: argparse.Namespace) -> None:
    """Simulate again to the same end, compare at every sample, write or fail."""
    require_writable(args.output)
    check = made_from(args.settings, Check)
    bound, tolerance = positive_number("bound", check.bound), positive_number("tolerance", check.tolerance)
    first = read_trajectory(args.trajectory)
    values = {key: value for key, value in first.metadata["scene"].items() if key != "start_angle"}
    numerics = Numerics(check.integrator, tolerance, tolerance, first.metadata["numerics"]["interval"])
    second = simulate(Scene.from_dict(values), numerics, t_end=float(first.t[-1]))
    difference = largest_distance(first.positions, second.positions, first.length)
    if not difference <= bound:
        raise NumericalError(f"runs differ by {difference:.3g} L, more than {bound:g} L; try a smaller rtol")
    facts = {
        "B": first.metadata["B"],
        "angle_index": first.metadata["angle_index"],
        "integrator": check.integrator,
        "tolerance": tolerance,
        "difference": difference,
        "bound": bound,
    }
    write_text(args.output, json.dumps(facts, sort_keys=True) + "\n")
