"""What a training refuses to learn from or to save, always with the trajectory's name."""

import copy
from dataclasses import replace

import numpy as np
import pytest
import torch

from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.model_files import save_autoencoder, save_forecast_model
from sedfiber.reduced.neural_ode import NeuralOde
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings, SourceNodeSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder
from sedfiber.reduced.training.train_node import train_node
from sedfiber.reduced.training.train_node_source import train_node_source
from tiny_fiber import settling, training_set

ENCODING = AutoencoderSettings((8,), modes_per_parity=4, samples_per_trajectory=8, batch_size=16, iterations=20)
NODE = NodeSettings((8,), samples_per_trajectory=8, matching_iterations=20, matching_batch_size=16)
NODE = replace(NODE, rollout_lengths=(4,), rollout_iterations=(30,), rollout_batch_steps=40)
SOURCE = SourceNodeSettings((8,), iterations=20, batch_size=16)


@pytest.fixture(scope="module")
def trained():
    """An autoencoder, trained once."""
    return train_autoencoder(training_set(), "decoder", 2, 0, ENCODING)


@pytest.fixture
def autoencoder(trained):
    """A copy for each test: one spoils its weights."""
    return copy.deepcopy(trained)


def with_nan(one):
    one.positions[3, 1, 0] = np.nan
    return one


def frozen(one):
    return replace(one, positions=np.repeat(one.positions[:1], len(one.t), axis=0))


BAD = {
    "values that are not finite": with_nan,
    "does not settle: at t = 12 its centre bead is where it started": frozen,
    "1 times and 1 samples": lambda one: replace(one, t=one.t[:1], positions=one.positions[:1]),
    "3 times and 25 samples": lambda one: replace(one, t=one.t[:3]),
    "times that do not ascend": lambda one: replace(one, t=one.t[::-1]),
}


@pytest.mark.parametrize("what", BAD)
def test_a_trajectory_that_cannot_be_learned_from_is_named(training, autoencoder, what):
    """Handed over in memory, to every training: one line with ℬ and angle index, and what to do."""
    spoilt = Dataset((*training.trajectories, BAD[what](settling(300.0, 9))))
    for train in (
        lambda: train_autoencoder(spoilt, "decoder", 2, 0, ENCODING),
        lambda: train_node(spoilt, autoencoder, 0, NODE),
        lambda: train_node_source(spoilt, autoencoder, 0, SOURCE),
    ):
        with pytest.raises(InputError, match=what) as error:
            train()
        assert "the trajectory with B = 300, angle_index = 9 " in str(error.value)
        assert "leave it out" in str(error.value) and "\n" not in str(error.value)


def test_no_trajectories_at_all_are_refused():
    """An empty data set has nothing to name."""
    with pytest.raises(InputError, match="empty"):
        Dataset(()).require_sound()


@pytest.mark.parametrize(
    ("train", "wild"),
    [
        (train_node, replace(NODE, rollout_learning_rate=1e6)),
        (train_node, replace(NODE, matching_learning_rate=1e9)),
        pytest.param(
            train_node_source,
            replace(SOURCE, iterations=200, learning_rate=1e9, final_learning_rate=1e9),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_training_that_blows_up_stops_with_a_trajectory(training, autoencoder, train, wild):
    """Rollouts, matching and the paper's recipe, each with a learning rate far too high."""
    said = []
    with pytest.raises(NumericalError, match=r"in the trajectory with B = .*, angle_index = .*try a smaller") as error:
        train(training, autoencoder, 0, wild, said.append)
    assert "\n" not in str(error.value)
    assert sum("step skipped" in line for line in said) == 5


def test_weights_that_are_not_finite_are_not_saved(training, autoencoder, tmp_path):
    """NumericalError, and no file."""
    node = NeuralOde((8,), 0.1, torch.ones(2), torch.ones(4), 0)
    next(node.parameters()).data[0, 0] = torch.nan
    with pytest.raises(NumericalError, match=r"node.*not finite"):
        save_forecast_model(ForecastModel(autoencoder, node, 1e-7, 1e-9), tmp_path, {})
    next(autoencoder.parameters()).data[0, 0] = torch.inf
    with pytest.raises(NumericalError, match=r"autoencoder.*not finite"):
        save_autoencoder(autoencoder, tmp_path, {})
    assert list(tmp_path.iterdir()) == []
