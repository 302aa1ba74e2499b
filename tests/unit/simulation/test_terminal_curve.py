"""The series of terminal shapes: what the steady solver says, to a billionth of a bead radius."""

import numpy as np
import pytest

from sedfiber import InputError, NumericalError, steady_state
from sedfiber.commands.cli import main
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, read_terminal_curve, write_terminal_curve


@pytest.fixture(scope="module")
def curve():
    """Seven beads, ℬ from 50 to 300."""
    return TerminalCurve.between(50.0, 300.0, 7)


@pytest.mark.parametrize("B", [50.0, 51.7, 123.4, 299.9, 300.0])
def test_agrees_with_the_steady_solver(curve, B):
    """At the ends, beside them, and between."""
    shape, velocity = curve(B)
    steady = steady_state(B, 7)
    assert np.abs(shape - steady.positions).max() < 1e-9
    assert np.abs(velocity - steady.velocity).max() < 1e-9


def test_one_elasto_gravitational_number_is_a_range_too():
    """A study of a single ℬ has a series of one term."""
    shape, _ = TerminalCurve.between(100.0, 100.0, 5)(100.0)
    assert np.array_equal(shape, steady_state(100.0, 5).positions)


def test_covers_its_range_only(curve):
    """Both ends belong to it."""
    assert [curve.covers(B) for B in (49.9, 50.0, 300.0, 300.1)] == [False, True, True, False]


def test_comes_back_from_its_file(curve, tmp_path):
    """Every bit, and twice the same bytes."""
    for name in ("one", "two"):
        write_terminal_curve(curve, tmp_path / name)
    again = read_terminal_curve(tmp_path / "one")
    assert np.array_equal(again.coefficients, curve.coefficients)
    assert (again.B_min, again.B_max, again.hydrodynamics, again.n_beads) == (50.0, 300.0, "RPY", 7)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()


def test_refuses_what_it_cannot_follow(tmp_path, capsys):
    """A range upside down, one beyond the fold of the U, and a file of something else, each in one line."""
    with pytest.raises(InputError, match="B_max: 100 is not allowed; give a number from B_min=200 up"):
        TerminalCurve.between(200.0, 100.0, 7)
    with pytest.raises(NumericalError, match="fold"):
        TerminalCurve.between(1e4, 1e5, 31)
    assert main(["simulate", "--B", "100", "--theta0", "0", "--t-end", "1", "-o", str(tmp_path / "run.parquet")]) == 0
    with pytest.raises(InputError, match="holds no terminal curve"):
        read_terminal_curve(tmp_path / "run.parquet")
    words = ["--settings", '{"B_min": -1, "B_max": 9}', "-o", str(tmp_path / "curve.parquet")]
    assert main(["solve_terminal_curve", *words]) == 1
    assert "B" in capsys.readouterr().err
    assert not (tmp_path / "curve.parquet").exists()
