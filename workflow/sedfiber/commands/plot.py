"""``sedfiber plot``: draw any trajectory, simulated or forecast."""

import argparse
import math
import textwrap
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.errors import InputError
from sedfiber.core.validation import refused
from sedfiber.figures.scene import draw_scene
from sedfiber.figures.style import B_SYMBOL, save_picture
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.simulation.trajectory_file import read_trajectory

SUFFIXES = (".png", ".svg")
_TITLE_WIDTH = 110  # letters
_MOST_SHOWN = 2  # different fibers, whose ℬ and θ₀ fit into a title


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The trajectory and the picture."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to draw")
    parser.add_argument(
        "-o", "--output", type=Path, help="picture to write, .png or .svg (the trajectory's name with .png, here)"
    )


def run(args: argparse.Namespace) -> None:
    """Refuse unusable outputs and files that tell no scene, then draw and write."""
    output = Path(f"{args.trajectory.stem}.png") if args.output is None else args.output
    if output.suffix not in SUFFIXES:
        raise refused("output", str(output), f"a name that ends in {' or '.join(SUFFIXES)}")
    require_writable(output)
    trajectory = read_trajectory(args.trajectory)
    if "space" not in trajectory.metadata.get("scene", {}):
        raise InputError(f"input: {str(args.trajectory)!r} does not say of what scene it is; give a trajectory file")
    save_picture(lambda: draw_scene(trajectory, title_of(trajectory)), output)
    if args.output is None:
        print(f"drew {output}")


def title_of(trajectory: Trajectory) -> str:
    """What the file says of itself: how it was made, ℬ and θ₀ of each fiber, or how many, what acts on it beside the
    study's effects, the settling time, and what a forecast was warned of.
    """
    facts, scene = trajectory.metadata, trajectory.metadata["scene"]
    made = "forecast" if facts.get("kind") == "forecast" else "simulated"
    fibers = list(dict.fromkeys(_fiber_words(scene | fiber) for fiber in scene.get("fibers") or [{}]))
    shown = "; ".join(fibers) if len(fibers) <= _MOST_SHOWN else f"{len(fibers)} different fibers"
    settled = trajectory.settling_time
    end = "" if settled is None else f", settled at t = {settled:.4g}"
    title = f"{made}: {shown}{_effects(scene)}{end}"
    warnings = facts.get("model", {}).get("warnings", [])
    doubts = textwrap.wrap(f"not to be relied on: {'; '.join(warnings)}", _TITLE_WIDTH) if warnings else []
    return "\n".join([title, *doubts])


def _effects(scene: dict) -> str:
    """Name the effects that the study's scene lacks, and those of the study's that this scene lacks."""
    flow = scene.get("flow", {})
    words = [f"no {key}" for key in ("gravity", "stretching", "bending") if scene.get(key, "") is None]
    words += [flow.get("name", "a linear") + " flow"] if flow else []
    words += [key for key in ("wall", "contact", "noise") if key in scene]
    words += [own["effect"] for own in scene.get("own", [])]
    return "".join(f", {word}" for word in words)


def _fiber_words(values: dict) -> str:
    """ℬ and θ₀ of one fiber."""
    return f"{B_SYMBOL} = {values['B']:g}, θ₀ = {values['theta0']:.4g} ({math.degrees(values['theta0']):.3g}°)"
