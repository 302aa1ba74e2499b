"""``sedfiber plot_model_diagram``: the parts of the reduced model and what passes between them."""

import argparse
from pathlib import Path

from sedfiber.figures.drawing import add_output_arguments, write_drawing
from sedfiber.figures.model_diagram import draw_model_diagram, read_sizes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The model's card, the two files to write."""
    parser.add_argument("card", type=Path, help="card.json of a trained forecast model")
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_drawing(args, lambda: draw_model_diagram(read_sizes(args.card)))
