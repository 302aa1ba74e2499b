"""``sedfiber plot_scene``: snapshots of a run and what changes along the way."""

import argparse
from pathlib import Path

from sedfiber.figures.drawing import add_output_arguments, write_drawing
from sedfiber.figures.scene import draw_scene
from sedfiber.simulation.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, its title, the two files to write."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to draw")
    parser.add_argument("--title", default="", help="words above the picture")
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_drawing(args, lambda: draw_scene(read_trajectory(args.trajectory), args.title))
