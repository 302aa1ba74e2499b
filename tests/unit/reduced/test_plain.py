"""Forecasts in plain NumPy: against torch's, which define them, against the compiled ones, and what they import."""

import dataclasses
import json
import subprocess
import sys

import numpy as np
import pytest

from forecast_models import distance, start_of, untrained
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.compiled.model import load_compiled
from sedfiber.reduced.forecaster import load_model, load_plain_model
from sedfiber.reduced.model_files import load_forecast_model, save_forecast_model
from sedfiber.reduced.plain.model import load_plain
from sedfiber.reduced.plain.path import LatentPath, Stuck, tolerances

CLOSE = 1e-6  # root-mean-square bead distance over L
T = 0.5 * np.arange(200)


@pytest.fixture(scope="module")
def starts():
    return [start_of(B, theta0) for B, theta0 in ((100.0, 0.3), (150.0, 1.2), (250.0, 0.9), (400.0, 1e-4))]


@pytest.fixture(scope="module")
def model(trained_model):
    return load_plain(trained_model)


@pytest.mark.parametrize("variant", ["none", "encoder", "decoder", "double"])
def test_forecast_of_every_variant_is_that_of_torch(variant, tmp_path):
    """Random weights in two hidden layers of unequal width, inside the training range and below it."""
    save_forecast_model(untrained(variant), tmp_path, {})
    starts = [start_of(200.0, 0.7, 5), start_of(50.0, 0.7, 5, nearest_B=100.0)]
    expected = load_forecast_model(tmp_path).forecast_many(starts, T)
    assert distance(load_plain(tmp_path).forecast_many(starts, T), expected) < CLOSE


@pytest.mark.parametrize("hidden", [(5,), (16, 7, 33)])
def test_one_hidden_layer_and_three(hidden, tmp_path):
    save_forecast_model(untrained("decoder", hidden=hidden), tmp_path, {})
    starts = [start_of(200.0, 0.7, 5)]
    expected = load_forecast_model(tmp_path).forecast_many(starts, T)
    assert distance(load_plain(tmp_path).forecast_many(starts, T), expected) < CLOSE


def test_forecast_is_that_of_torch_and_of_the_compiled_model(model, trained_model, starts):
    """Stiff and soft, steep and nearly symmetric."""
    found = model.forecast_many(starts, T)
    assert distance(found, load_forecast_model(trained_model).forecast_many(starts, T)) < CLOSE
    assert distance(found, load_compiled(trained_model).forecast_many(starts, T)) < CLOSE


@pytest.mark.parametrize(
    ("B", "theta0"), [(100, 1.0), (700, 0.065), (10000, 0.0), (10000, 1.4), (60, 0.5), (12000, 0.9)]
)
def test_the_shipped_model_is_forecast_alike(B, theta0):
    """31 beads and d = 4, until it has settled; the last two are outside the training range."""
    plain, compiled = load_plain_model(), load_model()
    settled = plain.settle(B, theta0)
    assert distance(settled.positions, compiled.forecast(B, theta0, settled.t)) < CLOSE
    assert settled.settling_time == pytest.approx(compiled.settle(B, theta0).settling_time, abs=1e-3)
    assert plain.warnings(B, theta0) == compiled.warnings(B, theta0)


def test_uneven_times_that_start_later(model, trained_model, starts):
    t = np.sort(np.random.default_rng(0).uniform(3.0, 150.0, size=80))
    expected = load_forecast_model(trained_model).forecast_many([starts[1]], t)[0]
    assert distance(model.forecast(starts[1], t), expected) < CLOSE


def test_a_state_does_not_depend_on_what_else_is_asked(model, trained_model, starts):
    """The same path goes on where it stopped: at once, in two halves, and after another start, bit by bit."""
    at_once = load_plain(trained_model).forecast(starts[0], T)
    first = model.forecast(starts[0], T[:40])
    later = model.forecast(starts[0], T[40:])
    assert np.array_equal(np.concatenate([first, later]), at_once)
    model.forecast(starts[1], T)
    assert np.array_equal(model.forecast(starts[0], T), at_once)


def test_many_samples_are_decoded_like_few(model, starts):
    """In blocks, of which the last is not full."""
    fine = np.linspace(0.0, 100.0, 601)
    every_third = model.forecast(starts[0], fine[::3])
    np.testing.assert_allclose(model.forecast(starts[0], fine)[::3], every_third, rtol=0, atol=1e-11)


def test_start_error_is_that_of_the_compiled_model(model, trained_model, starts):
    assert model.start_error(starts[1]) == pytest.approx(load_compiled(trained_model).start_error(starts[1]), rel=1e-9)


def _orbit_error(rtol):
    """Largest error on x'' = −x from (1, 0) over 20 units of time, between steps too, and the steps."""
    path = LatentPath(lambda y: np.array([y[1], -y[0]]), np.array([1.0, 0.0]), rtol, np.full(2, rtol))
    t = np.linspace(0.0, 20.0, 401)
    return np.abs(path(t) - np.column_stack([np.cos(t), -np.sin(t)])).max()


def test_error_falls_with_the_tolerance():
    """Nearly in proportion, as a pair whose error per step is controlled does."""
    slope = np.log10(_orbit_error(1e-4) / _orbit_error(1e-8)) / 4
    assert 0.7 < slope < 1.2


def test_tolerances_are_tighter_for_what_is_odd_and_small():
    """Two of four latent variables are odd under the mirror; an asymmetry of 1e-3 is followed to 1e-3 of the rest."""
    np.testing.assert_allclose(tolerances(np.array([1e-3, -1e-4, 0.5, 0.2, 0, 0]), 4, 1e-7)[:3], [1e-10, 1e-10, 1e-7])
    np.testing.assert_allclose(tolerances(np.zeros(6), 4, 1e-7)[0], 1e-13)


def test_a_path_that_cannot_go_on_says_where():
    """Rates that grow without bound at t = 1: y' = y², y(0) = 1."""
    with pytest.raises(Stuck) as found:
        LatentPath(lambda y: y**2, np.ones(1), 1e-6, np.full(1, 1e-6))(np.array([2.0]))
    assert found.value.args[0] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("t", [[], [-1.0, 0.0], [0.0, 0.0], [1.0, 0.5]])
def test_times_that_do_not_ascend_are_refused(model, starts, t):
    with pytest.raises(InputError, match="ascend"):
        model.forecast(starts[0], np.array(t))


def test_other_bead_count_and_starts_that_are_not_finite_are_refused(model, starts):
    with pytest.raises(InputError, match="7 beads, not on 5"):
        model.forecast(start_of(200.0, 0.3, 5), T)
    with pytest.raises(NumericalError, match="left the numbers"):
        model.forecast(dataclasses.replace(starts[0], initial=np.full((7, 3), np.nan)), T)


def test_a_folder_without_a_model_is_refused(tmp_path):
    with pytest.raises(InputError, match="no readable model"):
        load_plain(tmp_path)


SLOW = ("numba", "torch", "pandas", "scipy", "matplotlib")
IMPORTS = """
import json, sys
from sedfiber.commands.cli import main
status = main(["forecast", "--B", "1000", "--theta0", "0.7", "-o", sys.argv[1]])
print(json.dumps([status, [name for name in sys.argv[2:] if name in sys.modules]]))
"""


def test_a_forecast_imports_nothing_slow(tmp_path):
    """From the command to the written file, with the shipped model."""
    words = [sys.executable, "-c", IMPORTS, tmp_path / "f.parquet", *SLOW]
    said = subprocess.run(words, capture_output=True, text=True, check=True)
    assert json.loads(said.stdout) == [0, []]
