"""``sedfiber plot_cost_integrators``: time against error of every integrator."""

import argparse

from sedfiber.figures.cost_integrators import draw_cost_integrators
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "cost_integrators.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_cost_integrators)
