"""``sedfiber ship_model``: copy the forecast model of a full run into the package."""

import argparse
from pathlib import Path

from sedfiber.reduced.model_folder import SHIPPED
from sedfiber.study.shipping import ship


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the results are, and where the model goes."""
    parser.add_argument(
        "--results", type=Path, default=Path("results"), help="results of a full run (default: results)"
    )
    parser.add_argument("-o", "--output", type=Path, default=SHIPPED, help="folder to write (default: the package's)")
    parser.add_argument("--repository", type=Path, default=Path(), help="the checkout that ran (default: this folder)")


def run(args: argparse.Namespace) -> None:
    """Refuse, or copy and say what the model is worth."""
    sets = ship(args.results, args.output, args.repository)["error"]["sets"]
    worst = ", ".join(f"{of_set['E_worst']:.2g} on set {name}" for name, of_set in sets.items())
    print(f"shipped a model whose largest E is {worst}, in {args.output}; commit it")
