"""``sedfiber advise``: which method, tolerance or model reaches an accuracy, and what it takes on this machine."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.core.csv_file import read_csv
from sedfiber.core.errors import InputError
from sedfiber.core.validation import positive_number, whole_number
from sedfiber.study.costs.advice import Question, advice
from sedfiber.study.costs.machine import calibrated_unit

DEFAULT_TABLES = Path("results/tables")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The question, and where the measurements are."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    parser.add_argument("--error", required=True, help="largest root-mean-square bead distance over L that is allowed")
    parser.add_argument("--queries", default=1, help="number of trajectories (1)")
    parser.add_argument(
        "--tables", type=Path, default=DEFAULT_TABLES, help=f"folder of what snakemake cost measured ({DEFAULT_TABLES})"
    )


def run(args: argparse.Namespace) -> None:
    """Read the tables, time this machine for a second, print the advice."""
    question = Question(
        positive_number("B", args.B),
        positive_number("error", args.error),
        whole_number("queries", args.queries, "a whole number from 1 up", 1),
    )
    choices, discretisation = (_measured(args.tables / f"cost_{name}.csv") for name in ("choices", "discretisation"))
    scale = calibrated_unit() / choices["rhs_unit_s"].iloc[0]
    print("\n".join(advice(question, choices, discretisation, scale)))


def _measured(path: Path) -> pd.DataFrame:
    if not path.exists():
        raise InputError(f"tables: {str(path)!r} does not exist; run `snakemake -j1 cost` first, or give its folder")
    return read_csv(path)
