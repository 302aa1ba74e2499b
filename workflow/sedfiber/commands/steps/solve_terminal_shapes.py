"""``sedfiber solve_terminal_shapes``: steady shapes of several ℬ in one table."""

import argparse
from collections.abc import Sequence

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import steady_state
from sedfiber.simulation.equilibria.terminal_shapes import write_terminal_shapes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    add_settings_and_output(parser, "Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Solve at every ℬ and write one row each."""
    scenes = made_from(args.settings, _scenes)
    require_writable(args.output)
    states = [steady_state(scene.B, scene.n_beads, scene.hydrodynamics) for scene in scenes]
    write_terminal_shapes(states, args.output)


def _scenes(B: Sequence[float], n_beads: int = Scene.n_beads, hydrodynamics: str = Scene.hydrodynamics) -> list[Scene]:
    return [Scene(one, 0.0, n_beads, hydrodynamics=hydrodynamics) for one in B]
