"""Trainings that must stop with the name of the trajectory, or recover, and never leave a model full of NaN."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import torch

from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import Dataset, SettlingFall
from sedfiber.reduced.model_files import save_forecast_model
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings, SourceNodeSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder
from sedfiber.reduced.training.train_node import train_node
from sedfiber.reduced.training.train_node_source import train_node_source
from sedfiber.reduced.training.training import Descent, cosine_rate, soap
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import steady_state
from sedfiber.simulation.run import simulate
from sedfiber.study.angles import angle_of
from sedfiber.study.hard_cases.case import Measurement, must_refuse, yes_or_no

AUTOENCODER = AutoencoderSettings(
    decoder_hidden=(12,), modes_per_parity=4, samples_per_trajectory=16, batch_size=32, iterations=100
)
NODE = NodeSettings(
    hidden=(12,),
    samples_per_trajectory=16,
    matching_iterations=60,
    matching_batch_size=32,
    rollout_lengths=(8,),
    rollout_iterations=(30,),
    rollout_batch_steps=160,
)
SOURCE = SourceNodeSettings(hidden=(12,), iterations=60, batch_size=32)
SPOILT = 3  # of the six trajectories of `_sound`


def training_nan() -> Iterable[Measurement]:
    """One coordinate of one sample of one trajectory is NaN."""
    positions = _sound().trajectories[SPOILT].positions.copy()
    positions[7, 2, 1] = np.nan
    yield from _named(*_spoilt(positions=positions))


def training_constant() -> Iterable[Measurement]:
    """One trajectory never moves."""
    positions = _sound().trajectories[SPOILT].positions
    yield from _named(*_spoilt(positions=np.repeat(positions[:1], len(positions), axis=0)))


def training_diverging() -> Iterable[Measurement]:
    """A learning rate 1e6 too high, one bad loss in a sound training, and weights of NaN."""
    wild = replace(NODE, rollout_learning_rate=1e6 * NODE.rollout_learning_rate)
    stopped = must_refuse("", partial(train_node, _sound(), _autoencoder(), 0, wild), "bad steps in all")
    named = stopped.right and any(name in stopped.note for name in _sound().names)
    yield yes_or_no("rollouts that blow up: stopped in one line that names a trajectory", named, stopped.note)
    yield from _one_bad_loss()
    node = train_node(_sound(), _autoencoder(), 0, NODE)
    next(iter(node.parameters())).data.fill_(np.nan)
    model = ForecastModel(_autoencoder(), node, NODE.rtol, NODE.atol)
    with TemporaryDirectory() as folder:
        yield must_refuse("a model full of NaN: not saved", partial(save_forecast_model, model, Path(folder), {}))
        yield yes_or_no("a model that is not saved leaves no file", not list(Path(folder).iterdir()))


def _one_bad_loss() -> Iterable[Measurement]:
    """A linear regression, its columns of size 1 to 0.01, whose 30th loss is NaN: reported, skipped, and solved."""
    generator = torch.Generator().manual_seed(0)
    x = torch.randn(64, 8, generator=generator) * torch.logspace(0, -2, 8)
    truth = torch.randn(8, 3, generator=generator)
    weights = torch.zeros(8, 3, requires_grad=True)
    reports: list[str] = []
    descent = Descent(soap([weights]), ["one"], "a regression", reports.append)
    for step in range(300):
        errors = ((x @ weights - x @ truth) ** 2).mean(1) * (torch.nan if step == 30 else 1.0)
        loss = descent.step(cosine_rate(0.1, step, 300), errors.mean(), errors, torch.zeros(64, dtype=torch.long))
    note = reports[0] if reports else ""
    yield yes_or_no("one bad loss: reported once", len(reports) == 1, note)
    yield Measurement("one bad loss: loss at the end, 0.5 at the start", loss, 1e-5)


def simulated(n_beads: int, B_values: tuple[float, ...], angle_indices: tuple[int, ...]) -> Dataset:
    """Simulated fibers with their steady states, for trainings of a few seconds."""
    return Dataset(tuple(_simulated(n_beads, B, index) for B in B_values for index in angle_indices))


def _simulated(n_beads: int, B: float, index: int) -> SettlingFall:
    run, steady = simulate(Scene(B, angle_of(index), n_beads)), steady_state(B, n_beads)
    keys = {"split": "train", "angle_index": index}
    return SettlingFall(
        run.t, run.positions, run.metadata | keys, terminal=steady.positions, terminal_velocity=steady.velocity
    )


@cache
def _sound() -> Dataset:
    return simulated(5, (100.0, 300.0), (4, 10, 16))


@cache
def _autoencoder() -> Autoencoder:
    return train_autoencoder(_sound(), "decoder", 2, 0, AUTOENCODER)


def _spoilt(**changes: Any) -> tuple[Dataset, SettlingFall]:
    """The data set with one trajectory changed, and that trajectory."""
    all_of_them = list(_sound())
    all_of_them[SPOILT] = replace(all_of_them[SPOILT], **changes)
    return Dataset(tuple(all_of_them)), all_of_them[SPOILT]


def _named(training: Dataset, spoilt: SettlingFall) -> Iterable[Measurement]:
    """Every training must refuse the data set in one line that names the spoilt trajectory."""
    trainings: dict[str, Callable[[], object]] = {
        "autoencoder": partial(train_autoencoder, training, "decoder", 2, 0, AUTOENCODER),
        "neural ODE": partial(train_node, training, _autoencoder(), 0, NODE),
        "neural ODE of the paper": partial(train_node_source, training, _autoencoder(), 0, SOURCE),
    }
    for name, train in trainings.items():
        yield must_refuse(f"{name}: refused in one line that names the trajectory", train, spoilt.name)
