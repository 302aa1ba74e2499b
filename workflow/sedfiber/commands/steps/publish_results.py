"""``sedfiber publish_results``: copy tables, figures and manifest of a full run to where the repository shows them."""

import argparse
from pathlib import Path

from sedfiber.study.published import publish


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the results are, and where they go."""
    parser.add_argument(
        "--results", type=Path, default=Path("results"), help="results of a full run (default: results)"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        default=Path("results/published"),
        help="folder to write (default: results/published)",
    )
    parser.add_argument("--repository", type=Path, default=Path(), help="the checkout that ran (default: this folder)")


def run(args: argparse.Namespace) -> None:
    """Refuse, or copy and say how much."""
    files = publish(args.results, args.output, args.repository)
    size = sum(file.stat().st_size for file in files)
    print(f"published {len(files)} files, {size / 1e6:.1f} MB, in {args.output}; commit them")
