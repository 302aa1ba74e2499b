"""``sedfiber plot_problem``: the problem, its beads and the centre bead."""

import argparse
from pathlib import Path

from sedfiber.figures.drawing import add_output_arguments, write_drawing
from sedfiber.figures.problem import draw_problem
from sedfiber.simulation.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, the two files to write."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to draw")
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_drawing(args, lambda: draw_problem(read_trajectory(args.trajectory)))
