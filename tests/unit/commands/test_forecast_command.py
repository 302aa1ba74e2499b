"""`sedfiber forecast`: what it warns of in one line, what --strict refuses, and --shape."""

import numpy as np
import pytest

from sedfiber import read_trajectory
from sedfiber.commands.cli import main

N_BEADS = 7
ARCH = np.array([[-3.0, -4.0], [-3.0, -2.0], [-2.0, -0.3], [0.0, 0.0], [2.0, -0.3], [3.0, -2.0], [3.0, -4.0]])


@pytest.fixture
def command(trained_model, tmp_path, capsys):
    """Runs `sedfiber forecast` in a folder of its own; returns status, stderr and the file."""

    def run(*options):
        path = tmp_path / "out" / "x.parquet"
        path.parent.mkdir(exist_ok=True)
        status = main(["forecast", *map(str, options), "--model", str(trained_model), "-o", str(path)])
        return status, capsys.readouterr().err, path

    return run


def test_within_the_range_it_says_nothing(command):
    """--strict as well; the file's metadata has an empty list of warnings."""
    status, err, path = command("--B", 200, "--theta0", 0.3, "--strict")
    model = read_trajectory(path).metadata["model"]
    assert (status, err, model["warnings"], model["within_training_range"]) == (0, "", [], True)


@pytest.mark.parametrize("values", [("--B", 50, "--theta0", 0.3), ("--B", 200, "--theta0", 1.5708)])
def test_outside_the_range_one_line_warns_and_strict_refuses(command, values):
    """The same words on stderr and in the file; with --strict no file."""
    status, err, path = command(*values)
    model = read_trajectory(path).metadata["model"]
    assert status == 0 and err == f"sedfiber forecast: warning: {'; '.join(model['warnings'])}\n"
    assert "outside the training range" in err and model["within_training_range"] is False
    path.unlink()
    status, err, path = command(*values, "--strict")
    assert status == 1 and err.startswith("sedfiber forecast: strict: B=") and err.count("\n") == 1
    assert list(path.parent.iterdir()) == []


@pytest.mark.parametrize("suffix", ["csv", "npy", "parquet"])
def test_a_shape_comes_from_a_file(command, tmp_path, suffix):
    """Rows of numbers, or the last sample of a trajectory: here of a forecast, which is close to those seen."""
    file = tmp_path / f"shape.{suffix}"
    _, _, path = command("--B", 200, "--theta0", 0.3, "--t-end", 20)
    shape = read_trajectory(path).positions[-1]
    if suffix == "parquet":
        path.rename(file)
    else:
        np.save(file, shape) if suffix == "npy" else np.savetxt(file, shape, delimiter=",")
    status, err, path = command("--B", 200, "--theta0", 0, "--t-end", 5, "--shape", file, "--strict")
    assert (status, err) == (0, "")
    first = read_trajectory(path).positions[0]
    np.testing.assert_allclose(first, shape - shape[N_BEADS // 2], atol=0.01 * 2 * N_BEADS)


def test_a_far_shape_warns_and_strict_refuses(command, tmp_path):
    """An arch, which no settling fiber forms."""
    np.savetxt(tmp_path / "arch.csv", ARCH, delimiter=",")
    options = ("--B", 200, "--theta0", 0, "--shape", tmp_path / "arch.csv")
    status, err, path = command(*options)
    assert status == 0 and err.count("\n") == 1 and "warning: the start is far from any seen" in err
    assert read_trajectory(path).metadata["model"]["warnings"][0] in err
    path.unlink()
    status, err, path = command(*options, "--strict")
    assert status == 1 and "strict: the start is far from any seen" in err
    assert list(path.parent.iterdir()) == []


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (ARCH * np.nan, "7 rows"),
        (np.full((7, 2), np.inf), "7 rows"),
        (ARCH[:5], "7 rows"),
        (ARCH[:0], "7 rows"),
        (np.hstack([ARCH, ARCH[:, :1]]), "leaves the plane z = 0"),
        (np.zeros((7, 2)), "in one place"),
        (None, "cannot read"),
    ],
)
def test_bad_shapes_are_one_line(command, tmp_path, rows, words):
    """NaN, infinity, too few beads, none, out of the plane, all in one place, no file: nothing is written."""
    if rows is not None:
        np.savetxt(tmp_path / "bad.csv", rows, delimiter=",")
    status, err, path = command("--B", 200, "--theta0", 0, "--shape", tmp_path / "bad.csv")
    assert status == 1 and err.startswith("sedfiber forecast: s") and err.count("\n") == 1 and words in err
    assert list(path.parent.iterdir()) == []


def test_no_terminal_shape_is_one_line(command):
    """Above the fold of the U at 7 beads there is nothing to settle to."""
    status, err, path = command("--B", 1e5, "--theta0", 0.3)
    assert status == 1 and err.count("\n") == 1 and "ends in a fold" in err
    assert list(path.parent.iterdir()) == []
