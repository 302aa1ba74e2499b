"""The list of hard cases, its commands and its figure."""

import inspect
from importlib import import_module

import pandas as pd
import pytest

from figure_command import draw_words
from sedfiber.commands.cli import main
from sedfiber.core.errors import NumericalError
from sedfiber.study.hard_cases import start_cases
from sedfiber.study.hard_cases.case import FOLDER, Measurement, must_refuse, yes_or_no
from sedfiber.study.hard_cases.listing import CASES, NAMES


def test_names_are_unique():
    """The table and the files are keyed by them."""
    assert len(set(NAMES)) == len(NAMES)


@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_every_case_is_measured_by_the_function_of_its_name(case):
    """It exists, says what it does, and the case says why it is hard, what is right and against what."""
    function = getattr(import_module(f"{FOLDER}.{case.module}"), case.name)
    assert inspect.getdoc(function)
    assert case.why and case.right and case.reference


def test_what_counts_as_right():
    """At most the bound; a NaN never."""
    assert Measurement("x", 1.0, 1.0).right
    assert not Measurement("x", 1.1, 1.0).right
    assert not Measurement("x", float("nan"), 1.0).right
    assert yes_or_no("x", True).right
    assert not yes_or_no("x", False).right


def test_a_refusal_counts_when_its_line_says_what_it_should():
    """What goes through, or is refused for another reason, is wrong."""

    def refuse():
        raise NumericalError("LSODA: lost at t = 3")

    assert must_refuse("x", refuse, "LSODA", "t = 3").right
    assert not must_refuse("x", refuse, "Radau").right
    assert not must_refuse("x", lambda: None).right
    assert must_refuse("x", refuse).note == "LSODA: lost at t = 3"


def measured(tmp_path, name):
    """Exit status of the command on one case, and its table."""
    status = main(["measure_hard_case", name, "-o", str(tmp_path / "case.csv")])
    return status, pd.read_csv(tmp_path / "case.csv") if status == 0 else None


def test_the_command_writes_a_row_for_each_number(tmp_path, capsys):
    """Case, number, bound, verdict, seconds; the same on stdout."""
    status, table = measured(tmp_path, "nonsense_starts")
    assert status == 0
    assert list(table.columns[:5]) == ["case", "measured", "value", "bound", "verdict"]
    assert (table["verdict"] == "right").all()
    assert (table["seconds"] >= 0).all()
    assert "NaN: refused in one line" in capsys.readouterr().out


def test_a_case_that_falls_over_is_a_row_that_says_so(tmp_path, monkeypatch):
    """No case is left out because it fails."""

    def stumble():
        raise NumericalError("LSODA: lost at t = 3")

    monkeypatch.setattr(start_cases, "nonsense_starts", stumble)
    status, table = measured(tmp_path, "nonsense_starts")
    assert status == 0
    assert table["verdict"].tolist() == ["wrong"]
    assert table["note"].tolist() == ["LSODA: lost at t = 3"]


def test_an_unknown_case_is_refused(tmp_path, capsys):
    """One line with the names."""
    assert measured(tmp_path, "easy")[0] == 1
    assert "case: 'easy' is not allowed; give one of stiffest" in capsys.readouterr().err


def test_table_and_figure_show_failures(tmp_path, capsys):
    """Two cases below each other, the wrong one named on stdout and drawn."""
    rows = {"measured": "x", "bound": 1.0, "note": "", "seconds": 1.5}
    for name, value, verdict in (("one", 0.5, "right"), ("two", 2.0, "wrong")):
        pd.DataFrame([rows | {"case": name, "value": value, "verdict": verdict}]).to_csv(tmp_path / f"{name}.csv")
    files = [str(tmp_path / f"{name}.csv") for name in ("one", "two")]
    table = tmp_path / "hard_cases.csv"
    assert main(["tabulate_hard_cases", *files, "-o", str(table)]) == 0
    out = capsys.readouterr().out
    assert "2 cases, 2 measurements, 1 wrong" in out
    assert "wrong: two: x: 2, bound 1" in out
    assert main(draw_words("hard_cases", tmp_path, {"table": table})) == 0
    assert all((tmp_path / name).stat().st_size > 1000 for name in ("x.svg", "x.png"))
