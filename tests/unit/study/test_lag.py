"""The lag of a forecast, on a fiber that turns and bends as known, late or early by a known time."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from sedfiber.commands.cli import main
from sedfiber.core.errors import InputError
from sedfiber.core.parquet_file import coordinate_columns, write_table
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.reduced.measures import forecast_error
from sedfiber.study.error_tables import ModelLabel
from sedfiber.study.lag import MOVING, lag_rows, measure_lag
from tiny_fiber import bent_fiber, settling

T = np.arange(0.0, 12.05, 0.1)
WHO = ModelLabel("ours", "rollout", 4)


def turning(t, bend=0.3):
    """The fiber turns from 1 rad to level and bends to a U, both exponentially; it falls too."""
    fall = np.stack([0.1 * t, -2.0 * t, 0.0 * t], axis=-1)
    return bent_fiber(np.exp(-t / 3.0), bend * (1.0 - np.exp(-t))) + fall[:, None]


@pytest.mark.parametrize("lag", [0.02, 0.3, -0.3, 2.0])
def test_a_forecast_that_is_late_by_a_known_time_has_that_lag(lag):
    """To 1e-3 of it, wherever the true shape of that moment exists; nothing of the error is left."""
    measured = measure_lag(T, turning(T), turning(T - lag))
    reached = np.isfinite(measured.lag) & (measured.t >= lag)
    assert reached.sum() > 30
    np.testing.assert_allclose(measured.lag[reached], lag, rtol=1e-3)
    assert (measured.E_shape_unlagged[reached] < 1e-5 * measured.E_shape[reached]).all()


def test_a_forecast_of_another_shape_has_no_lag():
    """A bend out of the plane of motion: no earlier or later shape is closer, and all of the error is left."""
    forecast = turning(T)
    forecast[:, [0, -1], 2] += 0.5
    measured = measure_lag(T, turning(T), forecast)
    moving = np.isfinite(measured.lag)
    np.testing.assert_allclose(measured.lag[moving], 0.0, atol=1e-9)
    np.testing.assert_allclose(measured.E_shape_unlagged, measured.E_shape, rtol=1e-12)


def test_a_lag_and_another_shape_are_told_apart():
    """The lag is found; what is left is the error of the shape alone."""
    forecast = turning(T + 0.3)
    forecast[:, [0, -1], 2] += 0.5
    measured = measure_lag(T, turning(T), forecast)
    moving = np.isfinite(measured.lag)
    np.testing.assert_allclose(measured.lag[moving], -0.3, rtol=1e-3)
    left = 2 * 0.5**2 / (5 * 10.0**2)  # two beads of five, L = 10 a
    np.testing.assert_allclose(measured.E_shape_unlagged[moving], left, rtol=1e-4)
    assert measured.E_shape[moving].max() > 1.5 * left


def test_a_lag_is_defined_only_while_the_shape_moves():
    """A straight fiber turns at a rate that falls as exp(-t/3): below `MOVING` of the first there is no lag."""
    truth = turning(T, bend=0.0)
    measured = measure_lag(T, truth, turning(T + 0.3, bend=0.0))
    ends = -3.0 * np.log(MOVING)
    assert np.isfinite(measured.lag[measured.t < ends - 0.05]).all()
    late = measured.t > ends + 0.05
    assert np.isnan(measured.lag[late]).all()
    np.testing.assert_array_equal(measured.E_shape_unlagged[late], measured.E_shape[late])


def test_a_perfect_forecast_has_neither_lag_nor_error():
    measured = measure_lag(T, turning(T), turning(T))
    assert measured.largest == 0.0
    assert measured.E_shape.max() < 1e-28


def test_a_forecast_with_other_samples_is_refused():
    with pytest.raises(InputError, match="forecast has shape"):
        measure_lag(T, turning(T), turning(T)[:-1])


def fall(lag=0.0, split="A", angle_index=13):
    """One trajectory of the turning fiber, ``lag`` late."""
    return replace(settling(100.0, angle_index, split), t=T, positions=turning(T - lag))


def test_a_row_tells_the_moment_of_the_largest_error():
    """Early by 0.4: the error is largest when the fiber turns fastest, at once."""
    row = lag_rows(WHO, Dataset((fall(),)), Dataset((fall(-0.4),))).iloc[0]
    assert (row["model"], row["test_set"], row["B"], row["angle_index"]) == ("ours", "A", 100.0, 13)
    assert row["t_worst"] == T[1]
    assert row["lag"] == pytest.approx(-0.4, rel=1e-3)
    assert row["lag_max"] == pytest.approx(0.4, rel=1e-3)
    assert row["explained"] == pytest.approx(1.0, abs=1e-5)
    assert row["E_shape_max"] == forecast_error(fall().positions, fall(-0.4).positions).shape.max()


def test_other_trajectories_are_refused():
    with pytest.raises(InputError, match="not of the same"):
        lag_rows(WHO, Dataset((fall(angle_index=1),)), Dataset((fall(angle_index=3),)))


def tabulate(folder, *who):
    """Run the command on one trajectory of each set and forecasts of it, 0.4 early; its exit status."""
    steady = {"B": np.array([100.0])} | {f"velocity_{axis}": np.zeros(1) for axis in "xyz"}
    write_table(folder / "shapes.parquet", steady | coordinate_columns(fall().terminal[None]), {})
    for split in "AB":
        write_dataset([fall(split=split)], folder / f"{split}.parquet")
        write_dataset([fall(-0.4, split)], folder / f"forecast_{split}.parquet")
    files = {name: str(folder / f"{name}.parquet") for name in ("A", "B", "shapes", "forecast_A", "forecast_B")}
    truth = ["--truth", files["A"], files["shapes"], files["B"], files["shapes"]]
    forecasts = ["--forecasts", files["forecast_A"], files["forecast_B"]]
    settings = ["--settings", json.dumps({"forecasters": [who]})]
    return main(["tabulate_lags", *truth, *forecasts, *settings, "-o", str(folder / "lags.csv")])


def test_the_command_writes_a_row_for_each_trajectory(tmp_path):
    assert tabulate(tmp_path, "ours", "rollout", 4) == 0
    table = pd.read_csv(tmp_path / "lags.csv")
    assert list(table["test_set"]) == ["A", "B"]
    assert set(table["recipe"]) == {"rollout"} and set(table["latent_dim"]) == {4}
    np.testing.assert_allclose(table["lag"], -0.4, rtol=1e-3)


def test_the_command_refuses_an_unknown_recipe_in_one_line(tmp_path, capsys):
    assert tabulate(tmp_path, "ours", "guess", 4) == 1
    message = capsys.readouterr().err
    assert "recipe: 'guess' is not allowed" in message and message.count("\n") == 1
    assert not (tmp_path / "lags.csv").exists()
