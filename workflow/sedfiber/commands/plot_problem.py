"""``sedfiber plot_problem``: the problem, its beads and the centre bead."""

import argparse
from pathlib import Path

from sedfiber.atomic_file import require_writable
from sedfiber.figures.problem import draw_problem
from sedfiber.figures.style import save_figure
from sedfiber.trajectory_file import read_trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run, the two files to write."""
    parser.add_argument("trajectory", type=Path, help="trajectory file to draw")
    parser.add_argument("--svg", type=Path, required=True, help="SVG file to write")
    parser.add_argument("--png", type=Path, required=True, help="PNG file to write")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    for path in (args.svg, args.png):
        require_writable(path)
    trajectory = read_trajectory(args.trajectory)
    save_figure(lambda: draw_problem(trajectory), args.svg, args.png)
