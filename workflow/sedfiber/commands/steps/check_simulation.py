"""``sedfiber check_simulation``: one run again with another method and tighter tolerance."""

import argparse
import json
from pathlib import Path

from sedfiber.core.atomic_file import require_writable, write_text
from sedfiber.core.errors import NumericalError
from sedfiber.core.validation import positive_number
from sedfiber.physics.integrators import INTEGRATORS
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, the second method, and how far the two may differ."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to check")
    parser.add_argument("--integrator", default="Radau", help=f"{', '.join(INTEGRATORS)} (Radau)")
    parser.add_argument("--tolerance", default=1e-10, help="relative and absolute tolerance (1e-10)")
    parser.add_argument("--bound", default=1e-4, help="largest difference allowed, over L (1e-4)")
    parser.add_argument("-o", "--output", type=Path, required=True, help="JSON file to write")


def run(args: argparse.Namespace) -> None:
    """Simulate again to the same end, compare at every sample, write or fail."""
    require_writable(args.output)
    bound, tolerance = positive_number("bound", args.bound), positive_number("tolerance", args.tolerance)
    first = read_trajectory(args.trajectory)
    values = {key: value for key, value in first.metadata["scene"].items() if key != "start_angle"}
    numerics = Numerics(args.integrator, tolerance, tolerance, first.metadata["numerics"]["interval"])
    second = simulate(Scene.from_dict(values), numerics, t_end=float(first.t[-1]))
    difference = largest_distance(first.positions, second.positions, first.length)
    if not difference <= bound:
        raise NumericalError(f"runs differ by {difference:.3g} L, more than {bound:g} L; try a smaller rtol")
    facts = {
        "B": first.metadata["B"],
        "angle_index": first.metadata["angle_index"],
        "integrator": args.integrator,
        "tolerance": tolerance,
        "difference": difference,
        "bound": bound,
    }
    write_text(args.output, json.dumps(facts, sort_keys=True) + "\n")
