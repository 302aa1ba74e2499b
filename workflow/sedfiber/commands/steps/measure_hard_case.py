"""``sedfiber measure_hard_case``: run one hard case and say what it was measured by."""

import time
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output, Word
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError, SedfiberError
from sedfiber.study.hard_cases.case import HardCase, Measurement
from sedfiber.study.hard_cases.listing import case_of


def run(case: Word, *, output: Output, model: Path | None = None) -> None:
    """Measure and write a row for each number; a case that fails is a row that says so, not an error.

    The cases of forecasts need the folder of a trained ``model``.
    """
    asked = case_of(case)
    if asked.needs_model and model is None:
        raise InputError(f"model: missing; {asked.name} forecasts with a trained one, give its folder")
    before = time.perf_counter()
    found = _measured(asked, model)
    table = pd.DataFrame([_row(asked, one) for one in found])
    table["seconds"] = round(time.perf_counter() - before, 2)
    print(table[["measured", "value", "bound", "verdict"]].to_string(index=False))
    write_csv(table, output)


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
