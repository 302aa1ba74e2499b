"""`trace_states` and its figure on a fiber of seven beads: tables, figure, refusals."""

import json

import pandas as pd
import pytest

from figure_command import draw_words
from sedfiber.commands.cli import main

FEW = {"n_beads": 7, "B_min": 10, "B_max": 2000, "per_decade": 2, "hydrodynamics": "RPY"}
COLUMNS = [
    "branch", "B", "speed", "height", "end_to_end", "length", "residual", "in_plane_rate", "in_plane_symmetric_rate",
    "in_plane_measured", "out_of_plane_rate", "out_of_plane_measured", "stable_in_plane", "stable_in_volume",
]  # fmt: skip


def trace(folder, settings=FEW):
    """Exit status of the command that writes states.csv and thresholds.csv."""
    files = ["-o", str(folder / "states.csv"), "--thresholds", str(folder / "thresholds.csv")]
    return main(["trace_states", "--settings", json.dumps(settings), *files])


def draw(folder):
    """Exit status of the command that draws them."""
    inputs = {"table": folder / "states.csv", "thresholds": folder / "thresholds.csv"}
    return main(draw_words("states", folder, inputs))


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """A folder with both tables."""
    folder = tmp_path_factory.mktemp("states")
    assert trace(folder) == 0
    return folder


@pytest.fixture
def copied(tables, tmp_path):
    """The tables once more, to change."""
    for path in tables.glob("*.csv"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    return tmp_path


def change(path, **columns):
    """Set columns of a table."""
    pd.read_csv(path).assign(**columns).to_csv(path, index=False)


def test_the_tables(tables):
    """A row for each state, with both rates computed and measured; the U's fold among the thresholds."""
    states, thresholds = pd.read_csv(tables / "states.csv"), pd.read_csv(tables / "thresholds.csv")
    assert list(states) == COLUMNS
    assert set(states["branch"]) == {"U", "vertical"}
    assert (states["length"] == 14).all()
    assert states.loc[states["branch"] == "vertical", "in_plane_symmetric_rate"].isna().all()
    assert list(thresholds) == ["branch", "threshold", "B", "rate_below", "rate_above", "accuracy"]
    assert thresholds[["branch", "threshold"]].to_numpy().tolist() == [["U", "fold"]]
    assert thresholds["B"].item() == pytest.approx(1016.083, rel=1e-6)
    assert states["B"].max() == 2000.0 and states["B"].min() == 10.0


def test_what_it_prints(tmp_path, capsys):
    """The thresholds, why there is no W, and how well the measured rates agree."""
    assert trace(tmp_path) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "1016.08" in said.out and "no W found with 7 beads" in said.out
    largest = float(said.out.split("largest disagreement of a measured with a predicted rate: ")[1].split()[0])
    assert largest < 0.01


def test_a_second_run_gives_the_same_bytes(tables, tmp_path):
    """Both tables."""
    assert trace(tmp_path) == 0
    for name in ("states.csv", "thresholds.csv"):
        assert (tmp_path / name).read_bytes() == (tables / name).read_bytes()


@pytest.mark.parametrize(
    ("key", "value"),
    [
        *[("B_min", value) for value in (0, -1, "nan", "low")],
        *[("B_max", value) for value in ("inf", 10, 5, "high")],
        *[("per_decade", value) for value in (0, 2.5, "many", 10000)],
        *[("n_beads", value) for value in (8, "x")],
        ("hydrodynamics", "Stokes"),
    ],
)
def test_bad_values_are_refused_in_one_line(tmp_path, capsys, key, value):
    """Key, and what is allowed; nothing is written."""
    assert trace(tmp_path, FEW | {key: value}) == 1
    said = capsys.readouterr()
    assert said.err.startswith(f"sedfiber trace_states: {key}: ") and said.err.count("\n") == 1
    assert " is not allowed; give " in said.err and said.out == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("settings", [{"hydrodynamics": "none"}, {"n_beads": 1}])
def test_a_fiber_without_a_terminal_shape_is_refused(tmp_path, capsys, settings):
    """Without hydrodynamic interactions it falls as it is, and one bead has no shape."""
    assert trace(tmp_path, FEW | settings) == 1
    said = capsys.readouterr().err
    assert "no terminal shape" in said and said.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_refused_before_the_work(tmp_path, capsys, monkeypatch):
    """No state is solved for."""
    monkeypatch.setattr(
        "sedfiber.commands.steps.trace_states.trace_sections", lambda *args: pytest.fail("it traced first")
    )
    assert trace(tmp_path / "none") == 1
    assert capsys.readouterr().err.startswith("sedfiber trace_states: output: ")


def test_the_figure_is_drawn(copied):
    """From the two tables alone."""
    assert draw(copied) == 0
    assert (copied / "x.svg").read_bytes().startswith(b"<?xml")
    assert (copied / "x.png").read_bytes().startswith(b"\x89PNG")


def test_thresholds_may_be_none_or_closer_than_the_rows(copied):
    """A table with a header alone; two thresholds between two neighbouring rows."""
    path = copied / "thresholds.csv"
    header = path.read_text().splitlines()[0]
    path.write_text(header + "\n")
    assert draw(copied) == 0
    lines = [f"vertical,number of unstable modes changes,{B},,,0" for B in (500, 501, 502)]
    path.write_text("\n".join([header, *lines, "U,in-plane rate changes sign,20,,,0"]) + "\n")
    assert draw(copied) == 0


@pytest.mark.parametrize(
    ("columns", "reason"),
    [({"branch": "sideways"}, "'sideways' is not allowed"), ({"speed": "fast"}, "column speed must hold numbers")],
)
def test_a_wrong_table_is_refused(copied, capsys, columns, reason):
    """One line; nothing drawn."""
    change(copied / "states.csv", **columns)
    assert draw(copied) == 1
    said = capsys.readouterr().err
    assert reason in said and said.count("\n") == 1
    assert not (copied / "x.svg").exists()


@pytest.mark.parametrize("column", ["B", "length", "out_of_plane_rate", "stable_in_volume"])
def test_a_missing_column_is_named(copied, capsys, column):
    """The table must be that of trace_states."""
    path = copied / "states.csv"
    pd.read_csv(path).drop(columns=column).to_csv(path, index=False)
    assert draw(copied) == 1
    assert f"no column {column};" in capsys.readouterr().err
