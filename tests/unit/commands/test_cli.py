"""The command: the public interface of issue 2, and one line for everything that is wrong."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import sedfiber
from command_line import complaint, status_of
from sedfiber import Scene, read_trajectory, simulate
from sedfiber.commands.cli import COMMANDS, STEPS, THREADS, TOOLS, main

OPTIONS = {"--B": "1000", "--theta0": "0.7854", "--n-beads": "11", "--t-end": "2"}
SIMULATE = ["simulate", *(word for pair in OPTIONS.items() for word in pair)]


def test_simulate_writes_a_trajectory(tmp_path, capsys):
    """`sedfiber simulate --B … --theta0 … -o FILE`: the same samples as the Python interface; it says no more
    than one line for each effect that was left out.
    """
    path = tmp_path / "traj.parquet"
    assert status_of([*SIMULATE, "-o", path]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    run, direct = read_trajectory(path), simulate(Scene(1000, 0.7854, 11), t_end=2)
    assert np.array_equal(run.positions, direct.positions)
    assert run.metadata == direct.metadata | {"angle_index": None}
    assert said.out.splitlines() == [verdict["words"] for verdict in direct.metadata["audit"]]
    assert list(tmp_path.iterdir()) == [path]


def test_a_w_is_called_one(tmp_path, capsys):
    """The user reads it, and the file says it; there is no settling time, which is that to the U."""
    path = tmp_path / "w.parquet"
    options = ["--B", "10000", "--theta0", "0", "--tilt", "0"]
    assert status_of(["simulate", *options, "-o", path]) == 0
    assert capsys.readouterr().out.startswith("settled to the W, which is unstable")
    facts = read_trajectory(path).metadata
    assert (facts["settled_to"], facts["settling_time"]) == ("W", None)


def test_simulate_twice_gives_the_same_bytes(tmp_path):
    """A rerun is byte-identical (DESIGN §3)."""
    paths = [tmp_path / name for name in ("a.parquet", "b.parquet")]
    for path in paths:
        assert status_of([*SIMULATE, "-o", path]) == 0
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_simulate_passes_every_option_on(tmp_path):
    """Each option reaches the scene or the numerics, as the metadata shows."""
    path = tmp_path / "traj.parquet"
    options = "--space volume --hydrodynamics RPY-overlap --tilt 2e-4 --seed 3 --integrator BDF --rtol 1e-7 --atol 1e-6"
    argv = [*SIMULATE, *options.split(), "--interval", "0.25", "--max-time", "50", "--estimate-error", "-o", path]
    assert status_of(argv) == 0
    facts = read_trajectory(path).metadata
    assert facts["scene"] == {
        "B": 1000.0, "theta0": 0.7854, "n_beads": 11, "space": "volume", "hydrodynamics": "RPY-overlap",
        "tilt": 2e-4, "seed": 3, "start_angle": 0.7854, "gravity": {"direction": [0.0, -1.0, 0.0], "strength": 1.0},
        "stretching": {"factor": 1.0}, "bending": {"curvature": 0.0},
    }  # fmt: skip
    assert facts["numerics"] == {
        "integrator": "BDF", "rtol": 1e-7, "atol": 1e-6, "interval": 0.25, "max_time": 50.0, "t_end": 2.0,
        "estimate_error": True,
    }  # fmt: skip


def test_angle_index_stands_for_the_studys_grid(tmp_path):
    """θ₀ = k π/48, recorded with k itself: names hold k, never a rounded angle."""
    path = tmp_path / "traj.parquet"
    argv = ["simulate", "--B", "1000", "--angle-index", "11", "--n-beads", "11", "--t-end", "1", "-o", path]
    assert status_of(argv) == 0
    facts = read_trajectory(path).metadata
    assert facts["angle_index"] == 11
    assert facts["scene"]["theta0"] == 11 * np.pi / 48


@pytest.mark.parametrize(
    "angle",
    ["-0.5", "-1e-4"],
)
def test_negative_angles_are_angles(tmp_path, angle):
    """A leading minus is not taken for an option."""
    path = tmp_path / "traj.parquet"
    argv = ["simulate", "--B", "1000", "--theta0", angle, "--n-beads", "11", "--t-end", "1", "-o", path]
    assert status_of(argv) == 0
    assert read_trajectory(path).metadata["scene"]["theta0"] == float(angle)


def test_a_run_says_when_it_settled(tmp_path, capsys):
    """The first line; one that was cut off before says nothing of it."""
    words = ["simulate", "--B", "1000", "--theta0", "0.7854", "--n-beads", "11", "-o", tmp_path / "x.parquet"]
    assert status_of(words) == 0
    settled = read_trajectory(tmp_path / "x.parquet").settling_time
    assert capsys.readouterr().out.splitlines()[0] == f"settled to the U at t = {settled:.4g} a/U_s"
    assert status_of([*words, "--t-end", "2"]) == 0
    assert "settled" not in capsys.readouterr().out


def test_version(capsys):
    assert status_of(["--version"]) == 0
    assert capsys.readouterr().out == f"sedfiber {sedfiber.__version__}\n"


@pytest.mark.parametrize(
    ("option", "value", "key"),
    [
        *[("--B", value, "B") for value in ("0", "-5", "nan", "inf", "1e400", "text", "")],
        *[("--theta0", value, "theta0") for value in ("45", "nan", "inf", "steep")],
        *[("--n-beads", value, "n_beads") for value in ("30", "0", "-31", "3.5", "many")],
        *[("--space", "line", "space"), ("--hydrodynamics", "Stokes", "hydrodynamics")],
        *[("--integrator", "Euler", "integrator"), ("--integrator", "lsoda", "integrator")],
        *[("--rtol", "0", "rtol"), ("--atol", "-1e-8", "atol"), ("--interval", "nan", "interval")],
        *[("--t-end", "0", "t_end"), ("--t-end", "later", "t_end"), ("--max-time", "-1", "max_time")],
        *[("--tilt", "1", "tilt"), ("--seed", "1.5", "seed")],
    ],
)
def test_simulate_refuses_bad_values_by_name(tmp_path, capsys, option, value, key):
    """One line with command, key, value and what is allowed; nothing is written."""
    words = [f"{name}={text}" for name, text in (OPTIONS | {option: value}).items()]
    line = complaint(capsys, ["simulate", *words, "-o", tmp_path / "x.parquet"], 1)
    assert line.startswith(f"sedfiber simulate: {key}: ")
    assert value in line
    assert " is not allowed; give " in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("argv", "named"),
    [
        ([], "command: missing"),
        (["nonsense"], "'nonsense'"),
        (["--B", "1"], "command"),
        (["simulate", "--B", "1000", "--theta0", "0.5"], "-o/--output"),
        ([*SIMULATE, "--angle-index", "3", "-o", "x"], "--angle-index"),
        ([*SIMULATE, "-o", "x", "--colour", "red"], "--colour"),
        ([*SIMULATE, "-o"], "-o/--output"),
        (["steady", "--json"], "--B"),
        (["steady", "--B", "1000", "extra"], "extra"),
    ],
)
def test_bad_usage_is_one_line_with_status_two(capsys, tmp_path, monkeypatch, argv, named):
    """Missing, unknown and contradicting options are named; no page of usage."""
    monkeypatch.chdir(tmp_path)
    assert named in complaint(capsys, argv, 2)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("argv", "missing"), [([], "B"), (["--B", "1000"], "theta0"), (["--theta0", "1"], "B")])
def test_a_scene_without_a_file_needs_both_numbers(capsys, tmp_path, argv, missing):
    """The key that is missing, and that a file would do as well."""
    line = complaint(capsys, ["simulate", *argv, "-o", tmp_path / "x.parquet"], 1)
    assert line.startswith(f"sedfiber simulate: {missing}: missing; give --") and "scene file" in line


@pytest.mark.parametrize(
    "index",
    ["-1", "2.5", "k", "49"],
)
def test_angle_index_off_the_grid_is_refused(capsys, tmp_path, index):
    """k is a whole number from 0 to 48, a half turn."""
    argv = ["simulate", "--B", "1000", f"--angle-index={index}", "-o", tmp_path / "x.parquet"]
    assert complaint(capsys, argv, 1).startswith(f"sedfiber simulate: angle_index: '{index}' is not allowed")


def test_missing_output_folder_is_refused_before_the_work(capsys, tmp_path, monkeypatch):
    """The folder is looked at before a step is taken."""
    monkeypatch.setattr("sedfiber.commands.simulate.simulate", lambda *args: pytest.fail("it simulated first"))
    line = complaint(capsys, [*SIMULATE, "-o", tmp_path / "none" / "x.parquet"], 1)
    assert line.startswith("sedfiber simulate: output: ")
    assert str(tmp_path / "none") in line


def test_output_that_is_a_folder_is_refused(capsys, tmp_path):
    """A folder is not overwritten, and stays empty."""
    assert "is a folder" in complaint(capsys, [*SIMULATE, "-o", tmp_path], 1)
    assert list(tmp_path.iterdir()) == []


def test_output_folder_that_is_a_file_is_refused(capsys, tmp_path):
    """FILE/x.parquet cannot exist; FILE is left as it was."""
    file = tmp_path / "file"
    file.write_text("mine")
    assert str(file) in complaint(capsys, [*SIMULATE, "-o", file / "x.parquet"], 1)
    assert file.read_text() == "mine"


def test_numerical_failures_are_one_line(capsys, tmp_path):
    """A stiff fiber with the explicit integrator: the reason, the advice, and no file."""
    argv = ["simulate", "--B", "100", "--theta0", "0.5", "--integrator", "dopri5", "--interval", "5", "--t-end", "10"]
    line = complaint(capsys, [*argv, "-o", tmp_path / "x.parquet"], 1)
    assert "stiff" in line
    assert "implicit" in line
    assert list(tmp_path.iterdir()) == []


def test_help_lists_every_command(capsys):
    """Those that a user calls come first, with a summary each; then the steps of the workflow."""
    assert status_of(["--help"]) == 0
    said = capsys.readouterr().out
    assert all(name in said for name in COMMANDS)
    tools, _, steps = said.partition("steps of the workflow")
    assert all(f"  {name} " in tools and summary in tools for name, summary in TOOLS.items())
    assert all(name in steps for name in STEPS)


@pytest.mark.parametrize(("argv", "what"), [([], "missing"), (["forcast", "--B", "100"], "'forcast' is not allowed")])
def test_a_wrong_command_is_answered_with_those_that_a_user_calls(capsys, argv, what):
    """Not with all seventy."""
    line = complaint(capsys, argv, 2)
    assert what in line and "forecast" in line and "tabulate_lags" not in line


@pytest.mark.parametrize("command", ["simulate", "forecast"])
def test_a_trajectory_is_not_written_under_the_name_of_another_kind_of_file(capsys, tmp_path, command):
    """A .csv that holds Parquet would puzzle whatever opens it."""
    line = complaint(capsys, [command, "--B", "1000", "--theta0", "0.5", "-o", tmp_path / "x.csv"], 1)
    assert "x.csv" in line and ".parquet" in line
    assert list(tmp_path.iterdir()) == []


def run_process(*argv, **options):
    """The command in a process of its own, as a user or the workflow starts it."""
    return subprocess.run([sys.executable, *argv], capture_output=True, text=True, timeout=120, check=False, **options)


def test_module_is_the_command(tmp_path):
    """`python -m sedfiber` passes the exit status on, both ways."""
    good = run_process("-m", "sedfiber", "steady", "--B", "100", "--json")
    assert good.returncode == 0
    assert json.loads(good.stdout)["B"] == 100.0
    bad = run_process("-m", "sedfiber", "simulate", "--B=-1", "--theta0", "0", "-o", "x.parquet", cwd=tmp_path)
    assert bad.returncode == 1
    assert bad.stderr.count("\n") == 1
    assert bad.stderr.startswith("sedfiber simulate: B: '-1' is not allowed")
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize(("given", "found"), [({}, dict.fromkeys(THREADS, "1")), ({THREADS[0]: "2"},) * 2])
def test_a_command_runs_on_one_thread_unless_told_how_many(monkeypatch, capsys, given, found):
    """What NumPy will find when it is imported; the other variables stay unset, for they might be obeyed instead."""
    environment = {name: value for name, value in os.environ.items() if name not in THREADS} | given
    monkeypatch.setattr(os, "environ", environment)
    assert main(["effects"]) == 0
    assert {name: environment[name] for name in THREADS if name in environment} == found


def test_simulation_imports_neither_torch_nor_pandas_nor_matplotlib(tmp_path):
    """It runs 227 times; each of these costs more than a simulation (DESIGN §2)."""
    program = (
        "import sys; from sedfiber.commands.cli import main; "
        f"status = main({[*SIMULATE, '-o', str(tmp_path / 'x.parquet')]!r}); "
        "heavy = {'torch', 'pandas', 'matplotlib', 'torchdiffeq'} & set(sys.modules); "
        "print(status, sorted(heavy))"
    )
    assert run_process("-c", program).stdout.splitlines()[-1] == "0 []"


def test_what_needs_torch_says_so_where_it_is_not(tmp_path):
    """`pip install .` leaves it out: one line on how to get it, before anything else."""
    program = (
        "import sys; sys.modules['torch'] = None; from sedfiber.commands.cli import main; "
        "sys.exit(main(['train_node', 'd.parquet']))"
    )
    run = run_process("-c", program, cwd=tmp_path)
    assert run.returncode == 1 and run.stderr.count("\n") == 1
    assert "needs torch" in run.stderr and "[train]" in run.stderr
