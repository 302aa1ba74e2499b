"""Forecasts as a user meets them, where the model was not trained: ranges, shapes, precision, companions."""

import itertools
import math
import subprocess
import sys

import numpy as np
import pytest

from sedfiber import InputError, Scene, simulate, steady_state
from sedfiber.reduced.compiled.model import load_compiled
from sedfiber.reduced.forecaster import FAR, Forecaster, load_model
from sedfiber.reduced.model_files import load_forecast_model, save_forecast_model
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.settling import distance_to_terminal

N_BEADS, LENGTH = 7, 14.0
ARCH = [[-3.0, -4.0], [-3.0, -2.0], [-2.0, -0.3], [0.0, 0.0], [2.0, -0.3], [3.0, -2.0], [3.0, -4.0]]


@pytest.fixture(scope="module")
def forecaster(trained_model):
    """ℬ from 100 to 400, |θ₀| up to 20 π/48."""
    return load_model(trained_model)


def end_distance(positions, B):
    """Distance of the last sample from the steady solver's shape, over L."""
    last = positions[-1] - positions[-1, N_BEADS // 2]
    return distance_to_terminal(last, steady_state(B, N_BEADS).positions, LENGTH)


@pytest.mark.parametrize("B", [10.0, 50.0, 200.0, 800.0])
@pytest.mark.parametrize("theta0", [0.0, 1.0, math.pi / 2, 2.5, -math.pi])
def test_every_forecast_ends_at_the_terminal_shape_and_stays(forecaster, B, theta0):
    """Ten settling times, inside the training range and outside: the reference is the steady solver."""
    settled = forecaster.settle(B, theta0)
    assert settled.settling_time is not None
    positions = forecaster.forecast(B, theta0, np.linspace(0.0, 10.0 * settled.t[-1], 50))
    assert np.abs(positions - positions[:, 3:4]).max() < 0.6 * LENGTH
    assert end_distance(positions, B) < 1e-3


def test_below_the_range_the_fiber_turns_at_the_rate_of_a_stiff_one(forecaster):
    """At ℬ = 50, half of the least that was trained: the simulation's settling time to a tenth."""
    truth = simulate(Scene(50.0, 0.7, N_BEADS)).settling_time
    assert forecaster.settle(50.0, 0.7).settling_time == pytest.approx(truth, rel=0.1)


@pytest.mark.parametrize("theta0", [2.5, 3.0, -2.0, math.pi])
def test_a_turn_by_pi_is_the_same_fiber_counted_from_the_other_end(forecaster, theta0):
    """Exactly so in the simulation; a model trained on |θ₀| < π/2 knows it by being told."""
    t = np.linspace(0.0, 40.0, 9)
    one = forecaster.forecast(200.0, theta0, t)
    other = forecaster.forecast(200.0, theta0 - math.copysign(math.pi, theta0), t, "none")
    if theta0 != math.pi:  # where the other is exactly horizontal, and tilted
        np.testing.assert_allclose(one, other[:, ::-1], atol=1e-9)
    assert one[0, 0, 0] > one[0, -1, 0]
    assert forecaster.covers(200.0, theta0) == forecaster.covers(200.0, theta0 - math.copysign(math.pi, theta0))


def test_values_outside_the_range_are_named(forecaster):
    """ℬ, θ₀ and the range in words; nothing within it."""
    assert forecaster.warnings(200.0, 3.0) == []
    (words,) = forecaster.warnings(800.0, 0.0)[:1]
    assert words == f"B=800, theta0=0 is outside the training range ({forecaster.range_words()})"
    assert "outside the training range" in forecaster.warnings(200.0, math.pi / 2)[0]


def test_a_start_shape_is_turned_like_a_scene_turns_it(forecaster):
    """A straight shape by the angle is the straight start at that angle; a curved one starts where the scene does."""
    t = np.array([0.0, 5.0])
    straight = [[2.0 * k, 0.0] for k in range(N_BEADS)]
    by_shape, by_angle = forecaster.forecast(200.0, 0.7, t, straight), forecaster.forecast(200.0, 0.7, t)
    np.testing.assert_allclose(by_shape, by_angle, atol=1e-12)
    bent = [[2.0 * k, 0.02 * k * (6 - k)] for k in range(N_BEADS)]
    first = forecaster.forecast(200.0, 0.7, t, bent)[0]
    assert np.abs(first[:, :2] - Scene(200.0, 0.7, N_BEADS, shape=bent).start()).max() < 2 * FAR * LENGTH


def test_a_shape_far_from_any_seen_is_said_so(forecaster):
    """An arch opens downwards, while settling fibers open upwards; it still ends at the terminal shape."""
    settled = forecaster.settle(200.0, 0.3, shape=ARCH)
    (words,) = settled.metadata["model"]["warnings"]
    assert words.startswith("the start is far from any seen: 0.")
    assert settled.metadata["model"]["within_training_range"] is False
    assert end_distance(settled.positions, 200.0) < 1.1e-3


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        ([[x, y, 0.1 * x] for x, y in ARCH], "leaves the plane z = 0"),
        ([[math.nan, 0.0]] * N_BEADS, "not allowed"),
        (ARCH[:-1], "7 rows"),
        ([], "7 rows"),
    ],
)
def test_starts_that_are_none_are_refused(forecaster, shape, words):
    """The model is planar and has seven beads."""
    with pytest.raises(InputError, match=f"^shape: .*{words}"):
        forecaster.forecast(200.0, 0.3, [0.0, 1.0], shape)


def test_a_forecast_that_ends_elsewhere_says_so(trained_model, tmp_path):
    """A model whose rates are all zero never settles: it comes to rest where it starts."""
    model = load_forecast_model(trained_model)
    for tensor in (*model.node.parameters(), model.node.damping):
        tensor.data.zero_()
    save_forecast_model(model, tmp_path, {})
    still = load_model(tmp_path)
    settled = still.settle(200.0, 0.7)
    (words,) = settled.metadata["model"]["warnings"]
    assert settled.settling_time is None and words.startswith("the forecast comes to rest elsewhere: 0.")
    assert still.settle(200.0, 0.7, t_end=5.0).metadata["model"]["warnings"] == []


def test_a_forecast_that_never_settles_says_so(forecaster, monkeypatch):
    """The search for the settling time has an end."""
    monkeypatch.setattr("sedfiber.reduced.forecaster._MOST_SAMPLES", 2)
    monkeypatch.setattr("sedfiber.reduced.forecaster._FIRST_LOOK", 2)
    (words,) = forecaster.settle(200.0, 0.7).metadata["model"]["warnings"]
    assert words.startswith("the forecast has not settled by t=0.5: 0.")


def test_alone_in_a_sweep_and_by_torchdiffeq_agree(forecaster, trained_model):
    """Stiff and soft, steep and flat, and an arch; to 1e-6 L at every sample."""
    asked = [(B, theta0) for B in (10.0, 100.0, 400.0, 800.0) for theta0 in (0.0, 1.3, math.pi / 2)]
    starts = [*(forecaster.start(*one) for one in asked), forecaster.start(400.0, 0.3, ARCH)]
    t = np.linspace(0.0, 400.0, 101)
    alone = forecaster.model.forecast_many(starts, t)
    swept, offsets = forecaster.model.sweep(starts, t[1], [len(t)] * len(starts))
    batched = load_forecast_model(trained_model).forecast_many(starts, t)
    for one, other, rows in zip(alone, batched, np.split(swept, offsets[1:-1]), strict=True):
        assert largest_distance(one, other, LENGTH) < 1e-6
        assert largest_distance(one[..., :2], rows, LENGTH) < 1e-6


def test_a_sweep_takes_what_a_single_forecast_takes(forecaster):
    """ℬ and θ₀ as lists; samples of each start as many as were asked for; float32 far below what counts as settled."""
    B, theta0, counts = [100.0, 400.0, 250.0], [0.3, 1.2, 0.0], [5, 40, 20]
    positions, offsets = forecaster.sweep(B, theta0, 0.5, counts)
    rough, _ = forecaster.sweep(B, theta0, 0.5, counts, dtype=np.float32)
    assert list(offsets) == [0, 5, 45, 65] and positions.shape == rough.shape == (65, N_BEADS, 2)
    for start, (low, high) in enumerate(itertools.pairwise(offsets)):
        alone = forecaster.forecast(B[start], theta0[start], 0.5 * np.arange(counts[start]))
        assert largest_distance(alone[..., :2], positions[low:high], LENGTH) < 1e-6
        assert 0.0 < largest_distance(alone[..., :2], rough[low:high], LENGTH) < 1e-4


def test_a_sweep_of_lists_that_do_not_match_is_refused(forecaster):
    """With their lengths, before anything is computed."""
    with pytest.raises(InputError, match="2, 1 and 2 values"):
        forecaster.sweep([100.0, 400.0], [0.3], 0.5, [5, 5])


def test_a_terminal_shape_comes_from_the_series_or_the_solver(forecaster, trained_model):
    """The same start within the series' range with and without it, and beyond it from the solver alone."""
    bare = Forecaster(load_compiled(trained_model))
    for B in (100.0, 150.0, 400.0):
        one, other = forecaster.start(B, 0.5), bare.start(B, 0.5)
        assert np.abs(one.terminal - other.terminal).max() < 1e-9
    assert np.array_equal(forecaster.start(401.0, 0.5).terminal, steady_state(401.0, N_BEADS).positions)


def test_a_looser_tolerance_takes_fewer_evaluations(forecaster, trained_model):
    """And stays within a hundred times itself of the default's answer; one that is none is refused."""
    t = np.linspace(0.0, 100.0, 41)
    loose = load_model(trained_model, tolerance=1e-4)
    far = largest_distance(loose.forecast(200.0, 1.0, t), forecaster.forecast(200.0, 1.0, t), LENGTH)
    assert 1e-7 < far < 1e-2
    assert loose.model.evaluations < forecaster.model.evaluations
    with pytest.raises(InputError, match=r"^tolerance: 2\.0 is not allowed"):
        load_model(trained_model, tolerance=2.0)


def test_forecasting_needs_no_torch(trained_model):
    """Not imported, directly or not: it takes seconds."""
    words = f"import sys, sedfiber; sedfiber.load_model({str(trained_model)!r}).forecast(200, 0.5, [0.0, 1.0])"
    done = subprocess.run([sys.executable, "-c", f"{words}; sys.exit('torch' in sys.modules)"], check=False)
    assert done.returncode == 0
