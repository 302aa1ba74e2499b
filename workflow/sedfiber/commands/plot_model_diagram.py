"""``sedfiber plot_model_diagram``: the parts of the reduced model and what passes between them."""

import argparse
from pathlib import Path

from sedfiber.atomic_file import require_writable
from sedfiber.figures.model_diagram import draw_model_diagram, read_sizes
from sedfiber.figures.style import save_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The model's card, the two files to write."""
    parser.add_argument("card", type=Path, help="card.json of a trained forecast model")
    parser.add_argument("--svg", type=Path, required=True, help="SVG file to write")
    parser.add_argument("--png", type=Path, required=True, help="PNG file to write")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    for path in (args.svg, args.png):
        require_writable(path)
    sizes = read_sizes(args.card)
    save_figure(lambda: draw_model_diagram(sizes), args.svg, args.png)
