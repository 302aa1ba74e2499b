"""`sedfiber forecast TABLE`: a file for every row, all rows checked before the first is written."""

import io
import sys

import numpy as np
import pandas as pd
import pytest

from sedfiber import Scene, read_trajectory, simulate
from sedfiber.commands.cli import main
from sedfiber.core.progress_bar import FEW, simulated_time, with_progress

N_BEADS = 7


@pytest.fixture
def command(trained_model, tmp_path, capsys):
    """Writes a table, runs `sedfiber forecast` on it; returns status, stderr and the folder of the files."""

    def run(table, *options, suffix="csv"):
        path, into = tmp_path / f"starts.{suffix}", tmp_path / "out"
        path.write_text(table) if isinstance(table, str) else table.to_parquet(path)
        words = ["forecast", path, *options, "--model", trained_model, "-o", into, "--t-end", 5]
        status = main([str(word) for word in words])
        return status, capsys.readouterr().err, into

    return run


def test_every_row_is_written_as_alone(command, trained_model, tmp_path):
    """The same bytes as by --B and --theta0; the name says which."""
    status, err, into = command("B,theta0\n100,0.3\n250.5,-0.6\n400,0\n")
    assert (status, err) == (0, "")
    assert sorted(path.name for path in into.iterdir()) == [
        "B100_theta0.3.parquet", "B250.5_theta-0.6.parquet", "B400_theta0.parquet",
    ]  # fmt: skip
    alone = tmp_path / "alone.parquet"
    words = ["forecast", "--B", 250.5, "--theta0", -0.6, "--t-end", 5, "--model", trained_model, "-o", alone]
    assert main([str(word) for word in words]) == 0
    assert (into / "B250.5_theta-0.6.parquet").read_bytes() == alone.read_bytes()


def test_parquet_shapes_and_names(command, tmp_path):
    """A shape's path is relative to the table; what a row leaves empty is as if the column were not there."""
    np.savetxt(tmp_path / "bent.csv", [[2.0 * k, 0.02 * k * (6 - k)] for k in range(N_BEADS)], delimiter=",")
    table = pd.DataFrame({"B": [200.0, 200.0], "theta0": [0.3, 0.3], "shape": [None, "bent.csv"], "name": ["a", None]})
    status, _, into = command(table, suffix="parquet")
    names = ["a", "B200_theta0.3"]
    assert status == 0 and {path.stem for path in into.iterdir()} == set(names)
    shapes = [read_trajectory(into / f"{name}.parquet").metadata["scene"].get("shape") for name in names]
    assert shapes[0] is None and len(shapes[1]) == N_BEADS


def test_spreadsheet_marks_and_blanks_do_not_matter(command):
    status, err, into = command("\ufeffB, theta0 ,name\r\n 100 , 0.3, first fall\r\n\r\n")
    assert (status, err) == (0, "")
    assert [path.name for path in into.iterdir()] == ["first fall.parquet"]


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("B,theta0\n100,0.3\n-3,0.3\n", ["line 3: B: '-3' is not allowed", "above 0"]),
        ("B,theta0\n100,0.3\n100,\n", ["line 3: theta0: '' is not allowed", "radians between"]),
        ("B,theta0\n100,nan\n", ["line 2: theta0: 'nan' is not allowed"]),
        ("B,theta0\n100,0.3\n\n100,4\n", ["line 4: theta0: '4' is not allowed"]),
        ("B,theta0\n100,0.3,1\n", ["line 2: 3 cells; give 2"]),
        ("B,theta0\n100\n", ["line 2: 1 cells; give 2"]),
        ("B,angle\n100,0.3\n", ["no column 'theta0'", "B, theta0"]),
        ("B,theta0,speed\n100,0.3,1\n", ["column 'speed'", "shape, name"]),
        ("B,theta0\n", ["has no rows"]),
        ("", ["no column 'B'"]),
        ("B,theta0\n100,0.3\n100,0.3\n", ["line 3: name: 'B100_theta0.3' is not allowed", "line 2"]),
        ("B,theta0,name\n100,0.3,../x\n", ["line 2: name: '../x' is not allowed"]),
        ("B,theta0,shape\n100,0.3,no.csv\n", ["line 2: shape.file: cannot read"]),
        ("B,theta0\n100,0.3\n1e5,0.3\n", ["line 3: ", "ends in a fold"]),
    ],
)
def test_one_bad_row_and_nothing_is_written(command, table, words):
    """One line with the row's number, the column, the value and what is allowed."""
    status, err, into = command(table)
    assert status == 1 and err.count("\n") == 1 and not into.exists()
    for word in ["starts.csv", *words]:
        assert word in err


def test_a_bad_row_of_a_parquet_table_is_numbered_from_one(command):
    status, err, into = command(pd.DataFrame({"B": [100.0, 0.0], "theta0": [0.3, 0.3]}), suffix="parquet")
    assert status == 1 and "starts.parquet, row 2: B: 0.0 is not allowed" in err and not into.exists()


def test_what_is_no_table_is_one_line(command, tmp_path, capsys):
    """A file that is none of both, or is not there."""
    (tmp_path / "damaged.parquet").write_bytes(b"PAR1 and nothing else")
    for name in ("damaged.parquet", "missing.csv", "missing.parquet"):
        assert main(["forecast", str(tmp_path / name), "-o", str(tmp_path / "out")]) == 1
        err = capsys.readouterr().err
        assert err.count("\n") == 1 and f"{name}' (" in err


def test_warnings_are_one_line_and_strict_refuses_before_anything_is_written(command):
    """How many, and the first of them; each file holds its own."""
    table = "B,theta0\n100,0.3\n60,0.3\n500,0.3\n"
    status, err, into = command(table)
    assert status == 0 and err.count("\n") == 1 and "2 of 3 forecasts" in err and "starts.csv, line 3: B=60" in err
    assert read_trajectory(into / "B500_theta0.3.parquet").metadata["model"]["within_training_range"] is False
    for path in into.iterdir():
        path.unlink()
    into.rmdir()
    status, err, into = command(table, "--strict")
    assert status == 1 and "strict: starts.csv, line 3: B=60" in err and not into.exists()


@pytest.mark.parametrize("option", ["--B", "--theta0", "--shape"])
def test_a_table_and_a_single_start_do_not_go_together(command, option):
    status, err, into = command("B,theta0\n100,0.3\n", option, "1")
    assert status == 1 and f"leave out {option}" in err and not into.exists()


@pytest.mark.parametrize("words", [["--B", "100"], ["--theta0", "0.3"], []])
def test_neither_a_table_nor_a_start(words, tmp_path, capsys):
    assert main(["forecast", *words, "-o", str(tmp_path / "f.parquet")]) == 1
    assert "or a table of starts" in capsys.readouterr().err


class Terminal(io.StringIO):
    """A standard error that is a terminal."""

    def isatty(self):
        return True


def test_a_bar_is_drawn_for_many_on_a_terminal_alone(monkeypatch):
    """It is gone at the end; what is gone through does not change."""
    monkeypatch.setattr("sedfiber.core.progress_bar._PAUSE", -1.0)
    for items, stream, shown in (
        (range(FEW + 1), Terminal(), True),
        (range(FEW), Terminal(), False),
        (range(FEW + 1), io.StringIO(), False),
    ):
        monkeypatch.setattr(sys, "stderr", stream)
        assert list(with_progress(items)) == list(items)
        assert ("of 51" in stream.getvalue()) is shown
        assert stream.getvalue().split("\r")[-1].strip() == ""


def test_a_long_simulation_says_how_far_it_has_come(monkeypatch):
    """On a terminal, after some patience; nothing is left of it at the end."""
    monkeypatch.setattr("sedfiber.core.progress_bar._PATIENCE", -1.0)
    for stream, shown in ((Terminal(), True), (io.StringIO(), False)):
        monkeypatch.setattr(sys, "stderr", stream)
        with simulated_time() as progress:
            simulate(Scene(B=100, theta0=0.3, n_beads=3), t_end=5, progress=progress)
        assert ("of 5 a/U_s" in stream.getvalue()) is shown
        assert stream.getvalue().split("\r")[-1].strip() == ""


@pytest.mark.parametrize("name", ["all.parquet", "all.csv"])
def test_a_table_is_not_written_as_one_file(tmp_path, capsys, name):
    """Each row has a file of its own; a folder of that name would puzzle."""
    (tmp_path / "starts.csv").write_text("B,theta0\n1000,0.3\n")
    assert main(["forecast", str(tmp_path / "starts.csv"), "-o", str(tmp_path / name)]) == 1
    assert "give a folder" in capsys.readouterr().err
    assert not (tmp_path / name).exists()
