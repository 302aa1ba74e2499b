"""``sedfiber film_scene``: a film of a scene's run."""

import argparse
from pathlib import Path

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.figures.films.film import write_film
from sedfiber.figures.films.scene import film_scene
from sedfiber.simulation.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, its title and the film."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to film")
    add_settings_and_output(parser, "animated WebP file to write")


def run(args: argparse.Namespace) -> None:
    """Film the run."""
    require_writable(args.output)
    title = made_from(args.settings, _title)
    trajectory = read_trajectory(args.trajectory)
    write_film(lambda: film_scene(trajectory, title), args.output)


def _title(title: str = "") -> str:
    """The words above the picture."""
    return title
