"""The compiled forecast against the torch one, which defines it, and its parts against what they stand for."""

import dataclasses
import subprocess
import sys

import numpy as np
import pytest
import torch
from numba import njit

from forecast_models import distance, start_of, untrained
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.compiled.bead_path import DEGREE
from sedfiber.reduced.compiled.model import load_compiled
from sedfiber.reduced.compiled.perceptron import many, one, tanh_in_place
from sedfiber.reduced.compiled.runge_kutta import continue_step, error_ratio, stage
from sedfiber.reduced.compiled.tableau import STAGES
from sedfiber.reduced.model_files import load_forecast_model, save_autoencoder, save_forecast_model

CLOSE = 1e-6  # root-mean-square bead distance over L between the compiled forecast and the torch one
T = 0.5 * np.arange(200)


@pytest.fixture(scope="module")
def starts():
    return [start_of(B, theta0) for B, theta0 in ((100.0, 0.3), (150.0, 1.2), (250.0, 0.9), (400.0, 0.05))]


@pytest.fixture(scope="module")
def torch_model(trained_model):
    return load_forecast_model(trained_model)


@pytest.fixture(scope="module")
def model(trained_model):
    return load_compiled(trained_model)


@pytest.mark.parametrize("dtype, error", [(np.float64, 1e-12), (np.float32, 4e-7)])
def test_tanh(dtype, error):
    x = np.concatenate([np.linspace(-30, 30, 4001), [0.0, 1e300 if dtype == np.float64 else 1e30, np.nan]]).astype(
        dtype
    )
    expected = np.tanh(x)
    njit(lambda x: tanh_in_place(x))(x)
    np.testing.assert_allclose(x, expected, rtol=0, atol=error)


@pytest.mark.parametrize("hidden", [(5,), (12, 20), (16, 7, 33)])
def test_network_of_one_state_and_of_many_is_that_of_torch(hidden, tmp_path):
    torch_model = untrained("decoder", hidden=hidden)
    save_forecast_model(torch_model, tmp_path, {})
    own = load_compiled(tmp_path)._tables[3]
    node, context = torch_model._node, np.array([0.3, 0.0, 0.0, 0.2])
    h = np.random.default_rng(1).normal(size=(6, 3))
    with torch.no_grad():
        given = torch.tensor(context)[None].expand(6, -1)
        expected = node(torch.tensor(h), given, node.rest(given)).numpy()
    bias, work = own.rates_bias + own.rates_context @ context, np.empty((2, 2 * 6 * 48))
    rows, single, rest = np.empty((6, 5)), np.empty((6, 5)), np.empty(5)
    one(own.rates, bias, np.zeros(3), work, rest)
    for s in range(6):
        one(own.rates, bias, h[s], work, single[s])
    many(own.rates, bias[None], h, work, rows)
    damping = np.pad(own.damping * h, [(0, 0), (0, 2)])
    np.testing.assert_allclose(single - rest - damping, expected, atol=1e-11)
    np.testing.assert_allclose(rows - rest - damping, expected, atol=1e-11)


@pytest.mark.parametrize("variant", ["none", "encoder", "decoder", "double"])
def test_forecast_of_every_variant_is_that_of_torch(variant, tmp_path):
    save_forecast_model(untrained(variant), tmp_path, {})
    starts = [start_of(200.0, 0.7, 5), start_of(50.0, 0.7, 5, nearest_B=100.0)]
    expected = load_forecast_model(tmp_path).forecast_many(starts, T)
    assert distance(load_compiled(tmp_path).forecast_many(starts, T), expected) < CLOSE


@njit
def _orbit(steps):
    """A step method's errors on x'' = −x from (1, 0) over time 4: at its end, and midway within each step."""
    step = 4.0 / steps
    y, end, k, c = np.array([1.0, 0.0]), np.empty(2), np.empty((STAGES, 2)), np.empty((5, 2))
    worst = estimated = 0.0
    k[0] = np.array([0.0, -1.0])
    for n in range(steps):
        for i in range(1, STAGES):
            stage(i, y, k, step, end)
            k[i, 0], k[i, 1] = end[1], -end[0]
        continue_step(y, k, step, c)
        for theta in (0.3, 0.7):
            x = c[0, 0] + theta * (c[1, 0] + theta * (c[2, 0] + theta * (c[3, 0] + theta * c[4, 0])))
            worst = max(worst, abs(x - np.cos((n + theta) * step)))
        estimated = max(estimated, error_ratio(y, end, k, step, 0.0, np.ones(2)))
        y[:], k[0] = end, k[STAGES - 1]
    return np.hypot(y[0] - np.cos(4.0), y[1] + np.sin(4.0)), worst, estimated


def test_orders_of_the_runge_kutta_pair():
    """5 at the end of a step, 4 within, whose local error is of order 5, as is the estimate's."""
    slopes = np.log2(np.array(_orbit(40)) / np.array(_orbit(80)))
    assert 4.7 < slopes[0] < 5.6
    assert 3.7 < slopes[1] < 5.4
    assert 4.7 < slopes[2] < 5.4


def test_forecast_is_that_of_torch(model, torch_model, starts):
    assert distance(model.forecast_many(starts, T), torch_model.forecast_many(starts, T)) < CLOSE


def test_forecast_at_uneven_times_that_start_later(model, torch_model, starts):
    t = np.sort(np.random.default_rng(0).uniform(3.0, 150.0, size=80))
    assert distance(model.forecast(starts[1], t), torch_model.forecast_many([starts[1]], t)[0]) < CLOSE


@pytest.mark.parametrize("B, nearest", [(40.0, 100.0), (900.0, 400.0)])
def test_forecast_outside_the_training_range(model, torch_model, B, nearest):
    start = start_of(B, 0.8, nearest_B=nearest)
    assert distance(model.forecast(start, T), torch_model.forecast_many([start], T)[0]) < CLOSE


@pytest.mark.parametrize("t", [np.zeros(1), np.array([7.5]), np.array([0.0, 1e-3]), np.linspace(0, 300, 3)])
def test_forecast_at_few_times(model, torch_model, starts, t):
    assert distance(model.forecast(starts[2], t), torch_model.forecast_many([starts[2]], t)[0]) < CLOSE


def test_interpolated_samples_are_the_decoded_ones(model, starts):
    """Among many samples positions are interpolated, at few ones decoded."""
    fine = np.linspace(0, 100, 5001)
    few = fine[:: 5000 // DEGREE]
    assert distance(model.forecast(starts[0], fine)[:: 5000 // DEGREE], model.forecast(starts[0], few)) < CLOSE / 4


def test_plane_and_volume_agree_and_write_where_they_are_told(model, starts):
    out = np.empty((len(T), 7, 2))
    assert model.forecast_plane(starts[0], T, out) is out
    volume = model.forecast(starts[0], T)
    np.testing.assert_allclose(out, volume[:, :, :2], atol=1e-11)
    assert np.abs(volume[:, :, 2]).max() < 1e-12


def test_start_error_is_that_of_torch(model, torch_model, starts):
    assert model.start_error(starts[1]) == pytest.approx(torch_model.start_error(starts[1]), rel=1e-9)


@pytest.mark.parametrize("dtype, error", [(np.float64, 1e-11), (np.float32, 1e-5)])
def test_sweep_is_the_single_forecasts_one_after_the_other(model, starts, dtype, error):
    counts = [200, 1, 37, 150]
    together, offsets = model.sweep(starts, 0.5, counts, dtype=dtype)
    assert together.dtype == dtype and offsets.tolist() == [0, 200, 201, 238, 388]
    for s, start in enumerate(starts):
        alone = model.forecast_plane(start, T[: counts[s]])
        assert distance(together[offsets[s] : offsets[s + 1]], alone) < error


def test_sweep_does_not_depend_on_companions(model, starts):
    """More starts than lanes, so that some wait and lanes change places."""
    many_starts = [dataclasses.replace(starts[s % 4], initial=starts[s % 4].initial + s) for s in range(130)]
    counts = [20 + 3 * (s % 50) for s in range(130)]
    together, offsets = model.sweep(many_starts, 0.5, counts)
    for s in (0, 47, 48, 77, 129):
        alone, _ = model.sweep([many_starts[s]], 0.5, [counts[s]])
        assert distance(together[offsets[s] : offsets[s + 1]], alone) < 1e-11


def test_sweep_where_the_encoder_sees_B(tmp_path):
    save_forecast_model(untrained("double"), tmp_path, {})
    starts, model = [start_of(B, 0.7, 5) for B in (120.0, 300.0)], load_compiled(tmp_path)
    together, _ = model.sweep(starts, 0.5, [50, 50])
    assert distance(together.reshape(2, 50, 5, 2), model.forecast_many(starts, T[:50])[..., :2]) < 1e-11


def test_looser_tolerances_take_fewer_evaluations(trained_model, starts):
    used = []
    for rtol in (1e-3, 1e-6):
        model = load_compiled(trained_model, rtol, rtol)
        model.forecast(starts[0], T)
        used.append(model.evaluations)
    assert used[0] < 0.7 * used[1]


@pytest.mark.parametrize("t", [[], [-1.0, 0.0], [0.0, 0.0], [1.0, 0.5]])
def test_times_that_do_not_ascend_are_refused(model, starts, t):
    with pytest.raises(InputError, match="ascend"):
        model.forecast(starts[0], np.array(t))


def test_other_bead_count_is_refused(model):
    with pytest.raises(InputError, match="7 beads, not on 5"):
        model.forecast(start_of(200.0, 0.3, 5), T)


def test_memory_that_does_not_fit_is_refused(model, starts):
    with pytest.raises(InputError, match=r"out: .*\(200, 7, 2\)"):
        model.forecast_plane(starts[0], T, np.empty((200, 7, 3)))


@pytest.mark.parametrize("interval, counts", [(0.5, [10]), (0.5, [10, 10, 0, 10]), (0.0, [1, 1, 1, 1])])
def test_sweep_refuses_counts_and_intervals(model, starts, interval, counts):
    with pytest.raises(InputError, match=r"counts|interval"):
        model.sweep(starts, interval, counts)


def test_start_that_is_not_finite_is_refused(model, starts):
    broken = dataclasses.replace(starts[0], initial=np.full((7, 3), np.nan))
    with pytest.raises(NumericalError, match="left the numbers"):
        model.forecast(broken, T)
    with pytest.raises(NumericalError, match="left the numbers"):
        model.sweep([starts[1], broken], 0.5, [5, 5])


def test_files_that_hold_no_such_model_are_refused(tmp_path):
    with pytest.raises(InputError, match="no readable model"):
        load_compiled(tmp_path)
    torch_model = untrained("decoder")
    save_autoencoder(torch_model.autoencoder, tmp_path, {})
    with pytest.raises(InputError, match="'forecast model'"):
        load_compiled(tmp_path)
    save_forecast_model(torch_model, tmp_path, {})
    card, weights = tmp_path / "card.json", tmp_path / "model.safetensors"
    card.write_text(card.read_text().replace('"latent_dim": 3', '"latent_dim": 2'))
    with pytest.raises(InputError, match="does not fit"):
        load_compiled(tmp_path)
    weights.write_bytes(weights.read_bytes()[:-8])
    with pytest.raises(InputError, match="damaged or half-written"):
        load_compiled(tmp_path)


def test_torch_is_not_imported():
    code = "import sys, sedfiber.reduced.compiled.model; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
