"""``sedfiber plot_cost_physics``: what beads and hydrodynamics cost and change."""

import argparse
from pathlib import Path

from sedfiber.core.csv_file import read_csv
from sedfiber.figures.cost_physics import draw_cost_physics
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The three tables, the two files to write."""
    add_figure_arguments(parser, "cost_discretisation.csv")
    parser.add_argument("--growth", type=Path, required=True, help="CSV table of exponents (cost_growth.csv)")
    parser.add_argument(
        "--model-growth", type=Path, required=True, help="CSV table of simulation and forecast (cost_model_growth.csv)"
    )


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    growth, models = read_csv(args.growth), read_csv(args.model_growth)
    write_figure(args, lambda table: draw_cost_physics(table, growth, models))
