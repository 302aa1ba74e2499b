"""Reconstruction of trajectories by an autoencoder or by POD modes."""

import copy

import numpy as np
import torch

from sedfiber.core.array_types import Array
from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import SettlingFall
from sedfiber.reduced.measures import reconstruction_errors
from sedfiber.reduced.pod import ModalBasis
from sedfiber.reduced.scaling import Scales, residual_history


def autoencoder_errors(model: Autoencoder, trajectory: SettlingFall) -> Array:
    """‖X̌ − D(E(X̌; ℬ); ℬ)‖² at each stored sample, shape (T,), units of L/2 squared."""
    residual = residual_history(trajectory, model.scales)
    exact = copy.deepcopy(model).double()
    shapes = torch.tensor(residual)
    context = exact.context_of(trajectory.B, trajectory.terminal).expand(len(shapes), -1)
    with torch.no_grad():
        reconstructed = exact.decode(exact.encode(shapes, context), context)
    return reconstruction_errors(residual, reconstructed.numpy())


def pod_errors(basis: ModalBasis, scales: Scales, trajectory: SettlingFall) -> Array:
    """‖X̌ − Σ_j φ_j φ_j·X̌‖² at each stored sample, shape (T,), units of L/2 squared."""
    residual = residual_history(trajectory, scales)
    return reconstruction_errors(residual, basis.reconstruct(basis.coefficients(residual)))


def mean_over_samples(errors: list[Array]) -> float:
    """⟨…⟩ over all samples of all trajectories: the reconstruction loss of a test set."""
    return float(np.concatenate(errors).mean())
