"""What an explorer is made from: the same bytes from the same files, and one line for what does not fit."""

import shutil
from dataclasses import replace

import numpy as np
import pytest
from explorer_page import make

from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE

pytestmark = pytest.mark.slow


def test_the_same_input_gives_the_same_bytes(explorer, trained_model, dataset, tmp_path):
    make(trained_model, dataset, output=tmp_path / "again.html")
    assert (tmp_path / "again.html").read_bytes() == explorer.read_bytes()


def test_a_fall_outside_the_models_range_is_left_out_and_counted(falls, trained_model, tmp_path):
    """A test set may go beyond the training; the page cannot."""
    write_dataset([*falls, falls[0].with_facts(B=1000.0)], tmp_path / "falls.parquet")
    make(trained_model, tmp_path / "falls.parquet", output=tmp_path / "explorer.html")
    text = (tmp_path / "explorer.html").read_text(encoding="utf-8")
    assert "Simulated falls: training 2, test set B 1; 1 outside that range are not shown." in " ".join(text.split())


def broken(case: str, model, falls, folder) -> tuple:
    """Model folder and data set with something wrong."""
    write_dataset(falls, folder / "falls.parquet")
    if case == "no model":
        return folder, folder / "falls.parquet"
    if case == "no curve":
        shutil.copytree(model, folder / "model")
        (folder / "model" / CURVE).unlink()
        return folder / "model", folder / "falls.parquet"
    if case == "no data set":
        return model, folder / "missing.parquet"
    changes = {
        "other beads": {"positions": falls[0].positions[:, 1:-1]},
        "outside the range": {"metadata": falls[0].metadata | {"B": 1000.0}},
        "unknown split": {"metadata": falls[0].metadata | {"split": "C"}},
        "not finite": {"positions": falls[0].positions * np.nan},
        "out of the plane": {"positions": falls[0].positions + np.array([0.0, 0.0, 1.0])},
    }
    write_dataset([replace(falls[0], **changes[case])], folder / "falls.parquet")
    return model, folder / "falls.parquet"


@pytest.mark.parametrize(
    "case, words",
    [
        ("no model", "holds no readable model"),
        ("no curve", "solve_terminal_curve"),
        ("no data set", "cannot read"),
        ("other beads", "angle_index = 0 has 5 beads, the model 7"),
        ("outside the range", "no fall is within the model's range"),
        ("unknown split", "is of the split 'C'"),
        ("not finite", "not finite"),
        ("out of the plane", "leaves the plane"),
    ],
)
def test_bad_input_is_refused_in_one_line(case, words, trained_model, falls, tmp_path):
    """And nothing is written."""
    output = tmp_path / "page" / "explorer.html"
    output.parent.mkdir()
    with pytest.raises(InputError, match=words) as refusal:
        make(*broken(case, trained_model, falls, tmp_path), output=output)
    assert "\n" not in str(refusal.value) and not list(output.parent.iterdir())
