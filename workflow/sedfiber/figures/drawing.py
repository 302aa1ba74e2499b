"""The two files of a figure as options of a command, and how they are written."""

import argparse
from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure

from sedfiber.core.atomic_file import require_writable
from sedfiber.figures.style import save_figure


def add_output_arguments(parser: argparse.ArgumentParser) -> None:
    """The two files to write."""
    parser.add_argument("--svg", type=Path, required=True, help="SVG file to write")
    parser.add_argument("--png", type=Path, required=True, help="PNG file to write")


def write_drawing(args: argparse.Namespace, draw: Callable[[], Figure]) -> None:
    """Refuse unusable outputs, then read and draw, then write both files."""
    for path in (args.svg, args.png):
        require_writable(path)
    save_figure(draw, args.svg, args.png)
