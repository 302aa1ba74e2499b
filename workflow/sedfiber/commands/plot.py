"""``sedfiber plot``: draw any trajectory, simulated or forecast."""

import argparse
import math
from pathlib import Path

from sedfiber.atomic_file import require_writable
from sedfiber.errors import InputError
from sedfiber.figures.scene import draw_scene
from sedfiber.figures.style import B_SYMBOL, save_picture
from sedfiber.trajectory import Trajectory
from sedfiber.trajectory_file import read_trajectory
from sedfiber.validation import refused

SUFFIXES = (".png", ".svg")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The trajectory and the picture."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to draw")
    parser.add_argument("-o", "--output", type=Path, required=True, help="picture to write, .png or .svg")


def run(args: argparse.Namespace) -> None:
    """Refuse unusable outputs and files that tell no scene, then draw and write."""
    if args.output.suffix not in SUFFIXES:
        raise refused("output", str(args.output), f"a name that ends in {' or '.join(SUFFIXES)}")
    require_writable(args.output)
    trajectory = read_trajectory(args.trajectory)
    if "space" not in trajectory.metadata.get("scene", {}):
        raise InputError(f"input: {str(args.trajectory)!r} does not say of what scene it is; give a trajectory file")
    save_picture(lambda: draw_scene(trajectory, title_of(trajectory)), args.output)


def title_of(trajectory: Trajectory) -> str:
    """What the file says of itself: how it was made, ℬ, θ₀ and the settling time."""
    facts, scene = trajectory.metadata, trajectory.metadata["scene"]
    made = "forecast" if facts.get("kind") == "forecast" else "simulated"
    angle = f"θ₀ = {scene['theta0']:.4g} ({math.degrees(scene['theta0']):.3g}°)"
    settled = trajectory.settling_time
    end = "" if settled is None else f", settled at t = {settled:.4g}"
    return f"{made}: {B_SYMBOL} = {scene['B']:g}, {angle}{end}"
