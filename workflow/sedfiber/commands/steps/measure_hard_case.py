"""``sedfiber measure_hard_case``: run one hard case and say what it was measured by."""

import argparse
import time
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError, SedfiberError
from sedfiber.study.hard_cases.case import HardCase, Measurement
from sedfiber.study.hard_cases.listing import NAMES, case_of


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The case, and a model where it needs one."""
    parser.add_argument("case", help=f"one of {', '.join(NAMES)}")
    parser.add_argument("--model", type=Path, help="folder of a trained model, for the cases of forecasts")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Measure and write a row for each number; a case that fails is a row that says so, not an error."""
    case = case_of(args.case)
    if case.needs_model and args.model is None:
        raise InputError(f"model: missing; {case.name} forecasts with a trained one, give its folder")
    require_writable(args.output)
    before = time.perf_counter()
    found = _measured(case, args.model)
    table = pd.DataFrame([_row(case, one) for one in found])
    table["seconds"] = round(time.perf_counter() - before, 2)
    print(table[["measured", "value", "bound", "verdict"]].to_string(index=False))
    write_csv(table, args.output)


def _measured(case: HardCase, model: Path | None) -> list[Measurement]:
    try:
        return case.measure(model)
    except SedfiberError as error:  # the case itself fell over: that is its result
        return [Measurement("the case runs to its end", float("nan"), 0.0, str(error))]


def _row(case: HardCase, one: Measurement) -> dict:
    return {
        "case": case.name,
        "measured": one.what,
        "value": one.value,
        "bound": one.bound,
        "verdict": "right" if one.right else "wrong",
        "note": one.note,
        "why_hard": case.why,
        "counts_as_right": case.right,
        "reference": case.reference,
    }
