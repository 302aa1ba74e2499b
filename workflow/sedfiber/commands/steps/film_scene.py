"""``sedfiber film_scene``: a film of a scene's run."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.figures.films.film import write_film
from sedfiber.figures.films.scene import film_scene
from sedfiber.simulation.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, its title and the film."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to film")
    parser.add_argument("--title", default="", help="words above the picture")
    parser.add_argument("-o", "--output", type=Path, required=True, help="animated WebP file to write")


def run(args: argparse.Namespace) -> None:
    """Film the run."""
    require_writable(args.output)
    trajectory = read_trajectory(args.trajectory)
    write_film(lambda: film_scene(trajectory, args.title), args.output)
