"""``sedfiber plot_reconstruction``: reconstruction loss against latent dimension."""

import argparse

from sedfiber.figures.reconstruction import draw_reconstruction
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "reconstruction.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_reconstruction)
