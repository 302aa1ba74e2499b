"""Starts and models without training, for tests of what forecasts them."""

import numpy as np
import torch

from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.neural_ode import NeuralOde
from sedfiber.reduced.pod import ModalBasis
from sedfiber.reduced.scaling import Scales
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings
from sedfiber.simulation.equilibria.steady import steady_state


def distance(one, other):
    """Largest root-mean-square bead distance over L, L = 2N a, of two histories (…, N, dim)."""
    return np.sqrt(((one - other) ** 2).sum(-1).mean(-1)).max() / (2 * one.shape[-2])


def start_of(B, theta0, n_beads=7, nearest_B=None):
    """A straight fiber at an angle, and the steady states it needs."""
    along = 2.0 * (np.arange(n_beads) - n_beads // 2)[:, None]
    steady = steady_state(B, n_beads, "RPY")
    nearest = None if nearest_B is None else (nearest_B, steady_state(nearest_B, n_beads, "RPY").positions)
    direction = np.array([np.cos(theta0), np.sin(theta0), 0.0])
    return Start(B, along * direction + [3.0, -2.0, 0.0], steady.positions, steady.velocity, nearest)


def untrained(variant, d=3, hidden=(12, 20), seed=0):
    """A torch model with random weights, for 5 beads."""
    rng = np.random.default_rng(seed)
    modes = np.zeros((8, 5, 3))
    modes[:, :, :2] = np.linalg.qr(rng.normal(size=(10, 8)))[0].T.reshape(8, 5, 2)
    basis = ModalBasis(modes.reshape(8, 15), 4, rng.uniform(0.01, 0.1, size=8))
    settings = AutoencoderSettings(decoder_hidden=hidden, encoder_hidden=4)
    autoencoder = Autoencoder(variant, d, basis, Scales(5, 100.0, 400.0, 1.0), settings, seed)
    sizes = torch.tensor(rng.uniform(0.1, 0.5, size=2 * d + 2), dtype=torch.float32)
    node = NeuralOde(hidden, 0.1, sizes[:d], sizes[d:], seed)
    with torch.no_grad():
        for parameter in [*autoencoder.parameters(), *node.parameters()]:
            parameter += 0.1 * torch.tensor(rng.normal(size=parameter.shape), dtype=torch.float32)
    return ForecastModel(autoencoder, node, 1e-10, 1e-12)
