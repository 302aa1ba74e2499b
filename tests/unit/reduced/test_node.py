import copy

import numpy as np
import pytest
import torch
from scipy.integrate import solve_ivp

from sedfiber.core.errors import InputError
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.measures import forecast_error
from sedfiber.reduced.neural_ode import NeuralOde
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.node_data import encode_samples
from sedfiber.reduced.training.rollout import roll_out
from sedfiber.reduced.training.segments import draw_segments
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings, SourceNodeSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder
from sedfiber.reduced.training.train_node import train_node
from sedfiber.reduced.training.train_node_source import train_node_source
from tiny_fiber import settling, training_set

AUTOENCODER = AutoencoderSettings(
    decoder_hidden=(16,), modes_per_parity=4, samples_per_trajectory=12, batch_size=64, iterations=400
)
QUICK = NodeSettings(
    hidden=(12,),
    samples_per_trajectory=12,
    matching_iterations=20,
    matching_batch_size=32,
    rollout_lengths=(4, 6),
    rollout_iterations=(3, 3),
    rollout_batch_steps=60,
)


@pytest.fixture(scope="module")
def trained():
    """An autoencoder, trained once."""
    return train_autoencoder(training_set(), "decoder", 2, 0, AUTOENCODER)


@pytest.fixture
def autoencoder(trained):
    """A copy for each test: some change its precision."""
    return copy.deepcopy(trained)


@pytest.fixture
def node():
    return NeuralOde((8, 8), 0.1, torch.tensor([0.5, 0.2]), torch.tensor([0.3, 0.1, 0.2, 0.4]), 1).double()


def test_terminal_state_is_a_fixed_point_that_falls_steadily(node):
    context = torch.tensor([[-1.0, 0, 0.1], [0.3, 0, 0.4]], dtype=torch.float64)
    assert node(torch.zeros(2, 2, dtype=torch.float64), context, node.rest(context)).abs().max() < 1e-15


def test_damping_is_subtracted(node):
    h, context = torch.tensor([[0.3, -0.2]], dtype=torch.float64), torch.zeros(1, 3, dtype=torch.float64)
    damped = node(h, context, node.rest(context))
    node.damping.zero_()
    expected = torch.tensor([[0.1 * 0.5 * 0.3, 0.1 * 0.2 * -0.2, 0, 0]], dtype=torch.float64)
    torch.testing.assert_close(node(h, context, node.rest(context)) - damped, expected, atol=1e-8, rtol=0)


def test_rollout_converges_with_order_four(node):
    h, context = torch.tensor([[0.4, 0.3]], dtype=torch.float64), torch.tensor([[0.2, 0, 0.1]], dtype=torch.float64)

    def rates(_, y):
        with torch.no_grad():
            return node(torch.tensor(y[None, :2]), context, node.rest(context))[0].numpy()

    exact = solve_ivp(rates, (0, 8), [0.4, 0.3, 0, 0], rtol=1e-12, atol=1e-13).y[:, -1]

    def error(n):
        steps = torch.full((n, 1), 8.0 / n, dtype=torch.float64)
        with torch.no_grad():
            states = torch.cat([part[-1, 0] for part in roll_out(node, h, context, steps)])
        return np.linalg.norm(states.numpy() - exact)

    slope = np.log2(error(8) / error(16))
    assert 3.5 < slope < 4.6


def test_segments_follow_the_stored_samples(training, autoencoder):
    samples = encode_samples(training, autoencoder.double(), 12)
    generator = torch.Generator().manual_seed(0)
    drawn = draw_segments(samples, 200, 6, 0.5, 0.5, 3, generator)
    arrival = samples.t[drawn.start] + drawn.steps.cumsum(0)
    torch.testing.assert_close(arrival[drawn.stored], samples.t[drawn.target][drawn.stored])
    assert (drawn.target <= samples.last[drawn.which]).all() and (drawn.steps >= 0).all()
    assert (~drawn.stored).any() and (samples.t[drawn.start][~drawn.stored.all(0)] == 0).all()


@pytest.mark.slow
def test_training_forecasts_an_angle_it_has_not_seen(training, autoencoder):
    settings = NodeSettings(
        hidden=(24, 24),
        samples_per_trajectory=16,
        matching_iterations=600,
        matching_batch_size=128,
        rollout_lengths=(6,),
        rollout_iterations=(60,),
        rollout_batch_steps=300,
    )
    node = train_node(training, autoencoder, 0, settings)
    model = ForecastModel(autoencoder, node, settings.rtol, settings.atol)
    unseen = settling(300.0, 9)
    forecast = model.forecast_many([Start.of(unseen)], unseen.t)[0]
    assert forecast_error(unseen.positions, forecast).total.max() < 2e-3


@pytest.mark.slow
def test_source_recipe_lowers_its_loss(training, autoencoder):
    losses = []
    settings = SourceNodeSettings(hidden=(16,), iterations=150, batch_size=32)
    train_node_source(training, autoencoder, 0, settings, losses.append)
    untrained = []
    first = SourceNodeSettings(hidden=(16,), iterations=1, batch_size=32)
    train_node_source(training, autoencoder, 0, first, untrained.append)

    def loss(line):
        return float(line.split("loss ")[1].split(",")[0])

    assert loss(losses[-1]) < 0.3 * loss(untrained[-1])


@pytest.mark.parametrize(
    "train, settings",
    [
        (train_node, QUICK),
        (train_node_source, SourceNodeSettings(hidden=(8,), iterations=3, batch_size=16)),
    ],
)
def test_same_seed_gives_the_same_bytes(train, settings, training, autoencoder):
    first, second = (train(training, autoencoder, 5, settings).state_dict() for _ in range(2))
    assert all(first[name].numpy().tobytes() == second[name].numpy().tobytes() for name in first)


def test_training_leaves_the_autoencoder_alone(training, autoencoder):
    before = {name: value.clone() for name, value in autoencoder.state_dict().items()}
    train_node(training, autoencoder, 0, QUICK)
    assert all((before[name] == value).all() for name, value in autoencoder.state_dict().items())


@pytest.fixture(scope="module")
def model(trained):
    """Forecasts without a change to it, so that all tests share one."""
    autoencoder = copy.deepcopy(trained)
    return ForecastModel(autoencoder, train_node(training_set(), autoencoder, 0, QUICK), 1e-8, 1e-10)


def test_forecast_does_not_depend_on_companions_or_on_the_output_times(model):
    one, other = settling(100.0, 3), settling(300.0, 9)
    together = model.forecast_many([Start.of(one), Start.of(other)], one.t)[0]
    alone = model.forecast(one.B, one.positions[0], one.terminal, one.terminal_velocity, one.t[4:])
    np.testing.assert_allclose(together[4:], alone, atol=1e-5)


def test_forecast_is_carried_by_the_initial_position(model):
    one, t = settling(100.0, 3), np.array([0.0, 1.0, 2.0])
    here, there = (
        model.forecast(one.B, one.positions[0] + shift, one.terminal, one.terminal_velocity, t)
        for shift in (np.zeros(3), np.array([5.0, -7.0, 2.0]))
    )
    np.testing.assert_allclose(there - here, np.broadcast_to([5.0, -7.0, 2.0], here.shape), atol=1e-10)


def test_forecast_from_the_terminal_shape_only_falls(model):
    one, t = settling(300.0, 6), np.array([0.0, 50.0])
    forecast = model.forecast(one.B, one.terminal, one.terminal, one.terminal_velocity, t)
    np.testing.assert_allclose(forecast[1], one.terminal + 50.0 * one.terminal_velocity, atol=1e-9)


@pytest.mark.parametrize("t", [[], [-1.0, 0.0], [0.0, 0.0], [1.0, 0.5]])
def test_times_that_do_not_ascend_are_refused(model, t):
    one = settling(100.0, 3)
    with pytest.raises(InputError, match="ascend"):
        model.forecast_many([Start.of(one)], np.array(t))


def test_other_bead_count_is_refused(model):
    one = settling(100.0, 3)
    with pytest.raises(InputError, match="5 beads, not on 4"):
        model.forecast(one.B, one.positions[0, :4], one.terminal[:4], one.terminal_velocity, one.t)
