"""`sedfiber steady`: shape, speed and growth rates at one ℬ, for people and for programs."""

import json

import numpy as np
import pytest

from command_line import complaint, status_of
from sedfiber import read_trajectory, steady_state


def test_steady_prints_one_json_object(capsys):
    """`sedfiber steady --B 1000 --json`: the keys of issue 2 with the values of the Python interface."""
    assert status_of(["steady", "--B", "1000", "--json"]) == 0
    said = capsys.readouterr()
    values, state = json.loads(said.out), steady_state(1000)
    assert said.out.count("\n") == 1
    assert said.err == ""
    assert (values["B"], values["n_beads"]) == (1000.0, 31)
    assert values["velocity"] == state.speed
    assert values["height"] == state.height
    assert values["end_to_end"] == state.end_to_end
    assert values["residual"] <= 1e-10
    assert values["B_force_consistent"] == pytest.approx(2000 / 3)
    assert values["modulus"] == pytest.approx(714.984)
    assert values["branch"] == "U"
    assert (values["stable_in_plane"], values["stable_in_volume"]) == (True, True)
    assert values["in_plane_rate"] < values["out_of_plane_rate"] < 0.0
    assert all(isinstance(value, int | float) for key, value in values.items() if key != "branch")


def test_steady_finds_the_unstable_w(capsys):
    """`--branch W` at ℬ = 10000: flatter than the U, unstable in the plane; text and JSON say the same."""
    assert status_of(["steady", "--B", "10000", "--branch", "W", "--json"]) == 0
    values, state = json.loads(capsys.readouterr().out), steady_state(10000, branch="W")
    assert (values["branch"], values["height"]) == ("W", state.height)
    assert values["height"] < 0.6 * steady_state(10000).height
    assert (values["stable_in_plane"], values["stable_in_volume"]) == (False, False)
    assert values["in_plane_rate"] == pytest.approx(0.0809, abs=1e-4)
    assert status_of(["steady", "--B", "10000", "--branch", "W"]) == 0
    lines = dict(line.split()[:2] for line in capsys.readouterr().out.splitlines())
    assert lines == {key: str(value) for key, value in values.items()}


def test_steady_writes_the_shape_as_a_scene_takes_it(tmp_path, capsys):
    """Every digit: a fiber that starts in it stays."""
    path = tmp_path / "u.csv"
    assert status_of(["steady", "--B", "1000", "--n-beads", "11", "-o", path]) == 0
    assert np.array_equal(np.loadtxt(path, delimiter=","), steady_state(1000, 11).positions)
    words = ["simulate", "--B", "1000", "--theta0", "0", "--n-beads", "11", "--shape", path, "--t-end", "5"]
    assert status_of([*words, "-o", tmp_path / "x.parquet"]) == 0
    run = read_trajectory(tmp_path / "x.parquet")
    assert np.abs(run.shape[-1] - run.shape[0]).max() < 1e-8


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--B", "10000", "--branch", "V"], "branch: 'V' is not allowed; give one of U, W"),
        (["--B", "5000", "--branch", "W"], "it ends in a fold at B=6975.04"),
        (["--B", "70000"], "it ends in a fold at B=63299.4"),
    ],
)
def test_steady_refuses_a_branch_that_is_not_there(capsys, words, reason):
    """One line; where a fold ends the branch, it says where."""
    assert reason in complaint(capsys, ["steady", *words], 1)


def test_steady_prints_the_same_for_people(capsys):
    """Without --json: one line a key."""
    assert status_of(["steady", "--B", "1000"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert {"B", "velocity", "height", "end_to_end"} <= {line.split()[0] for line in lines}
    assert {line.split()[0] for line in lines if line.endswith(" U_s")} == {"velocity", "residual"}


@pytest.mark.parametrize("value", ["0", "-5", "nan", "inf", "text"])
def test_steady_refuses_bad_numbers(capsys, value):
    """The same line from the other command."""
    assert complaint(capsys, ["steady", f"--B={value}", "--json"], 1).startswith(f"sedfiber steady: B: {value!r} is")
