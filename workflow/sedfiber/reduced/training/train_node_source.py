"""The paper's own recipe for the neural ODE.

One step τ through torchdiffeq from every stored sample, even in time, with the loss

    ⟨‖h(t+τ) − h̃(t+τ)‖²⟩ + ⟨‖c(t+τ) − c̃(t+τ)‖²⟩

in which h and c have equal weight; c in units of L/2. Adam, by the sibling papers.
"""

import copy

import numpy as np
import torch
from torch import Tensor, nn
from torchdiffeq import odeint

from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.neural_ode import N_CENTRE, NeuralOde
from sedfiber.reduced.scaling import Scales, residual_history
from sedfiber.reduced.training.node_data import encode_samples
from sedfiber.reduced.training.settings import SourceNodeSettings
from sedfiber.reduced.training.train_node import new_node
from sedfiber.reduced.training.training import Descent, Progress, ProgressLine, silent

SCALE_SAMPLES = 64  # only for std(h) and the size of the rates, which scale the network


def train_node_source(
    training: Dataset,
    autoencoder: Autoencoder,
    seed: int,
    settings: SourceNodeSettings,
    progress: Progress = silent,
) -> NeuralOde:
    """Train by the paper's recipe; the same arguments give the same bytes.

    Raises InputError for a trajectory that cannot be learned from, NumericalError when the
    training diverges; both name the trajectory.
    """
    training.require_sound()
    scales = autoencoder.scales
    exact = copy.deepcopy(autoencoder).double()
    samples = encode_samples(training, exact, SCALE_SAMPLES)
    node = new_node(samples, settings.hidden, settings.damping, seed)
    which = torch.repeat_interleave(torch.tensor([len(one.t) - 1 for one in training]))
    _fit(node, (*_pairs(training, exact, scales), which), settings, training.names, seed, progress)
    return node


def _pairs(training: Dataset, encoder: Autoencoder, scales: Scales) -> tuple[Tensor, ...]:
    """All pairs of neighbouring samples: start h, context, target [h, drift], τ; float32 rows."""
    columns: tuple[list[Tensor], ...] = [], [], [], []
    for trajectory in training:
        residual = torch.tensor(residual_history(trajectory, scales))
        context = encoder.context_of(trajectory.B, trajectory.terminal).expand(len(residual), -1)
        with torch.no_grad():
            h = encoder.encode(residual, context)
        centre = torch.tensor(scales.centre(trajectory.positions)[:, :N_CENTRE])
        steady = torch.tensor(trajectory.terminal_velocity[:N_CENTRE] / scales.half_length)
        tau = torch.tensor(np.diff(trajectory.t))[:, None]
        target = torch.cat([h[1:], centre.diff(dim=0) - tau * steady], dim=1)
        for column, rows in zip(columns, (h[:-1], context[1:], target, tau), strict=True):
            column.append(rows)
    return tuple(torch.cat(column).float() for column in columns)


def _fit(
    node: NeuralOde,
    pairs: tuple[Tensor, ...],
    settings: SourceNodeSettings,
    names: list[str],
    seed: int,
    progress: Progress,
) -> None:
    generator = torch.Generator().manual_seed(seed)
    name = f"neural ODE of the paper, d = {node.latent_dim}"
    descent = Descent(torch.optim.Adam(node.parameters()), names, name, progress)
    line = ProgressLine(name, settings.iterations, progress)
    for step in range(settings.iterations):
        early = step < 2 * settings.iterations // 3
        rate = settings.learning_rate if early else settings.final_learning_rate
        rows = torch.randint(len(pairs[0]), (settings.batch_size,), generator=generator)
        h, context, target, tau, which = (column[rows] for column in pairs)
        errors = _one_step_errors(node, h, context, target, tau, settings)
        line.update(step, descent.step(rate, errors.mean(), errors, which))


def _one_step_errors(
    node: NeuralOde, h: Tensor, context: Tensor, target: Tensor, tau: Tensor, settings: SourceNodeSettings
) -> Tensor:
    """‖h(t+τ) − h̃(t+τ)‖² + ‖c(t+τ) − c̃(t+τ)‖² of each pair (S,); infinite where dopri5 gives up."""
    rest, d = node.rest(context), node.latent_dim

    # In units of τ all pairs of the batch take one step of length 1.
    def rates(_: Tensor, state: Tensor) -> Tensor:
        return tau * node(state[:, :d], context, rest)

    start = nn.functional.pad(h, (0, N_CENTRE))
    times = torch.tensor([0.0, 1.0])
    try:
        end = odeint(rates, start, times, rtol=settings.rtol, atol=settings.atol, method="dopri5")[-1]
    except AssertionError:  # no step is small enough for the fastest pair of the batch
        speed = rates(times[0], start).square().sum(1).nan_to_num(nan=torch.inf)
        return torch.where(speed == speed.max(), torch.inf, 0.0)
    return (end - target).square().sum(1)
