"""``sedfiber make_explorer``: the trained model as one HTML page that forecasts in the browser, offline."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable, write_text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The model, the simulated falls to compare it with, and the page."""
    parser.add_argument("--model", type=Path, required=True, help="model folder, its terminal curve in it")
    parser.add_argument("--dataset", nargs="+", type=Path, required=True, help="Parquet files of simulated falls")
    parser.add_argument("-o", "--output", type=Path, required=True, help="HTML file to write")


def run(args: argparse.Namespace) -> None:
    """Read, put together, write."""
    require_writable(args.output)
    from sedfiber.figures.explorer.page import explorer_page  # its imports take a second: bad input fails before it

    write_text(args.output, explorer_page(args.model, args.dataset))
