"""Training of an autoencoder: the reconstruction loss ⟨‖X̌ − D(E(X̌; ℬ); ℬ)‖²⟩.

The modes are orthonormal and fixed, so the loss is taken on modal coefficients; what the
modes leave out does not depend on the weights.
"""

import numpy as np
import torch
from torch import Tensor

from sedfiber.core.array_types import Array
from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.pod import modal_basis
from sedfiber.reduced.scaling import Scales, residual_history
from sedfiber.reduced.training.sampling import path_even_indices
from sedfiber.reduced.training.settings import AutoencoderSettings
from sedfiber.reduced.training.training import Descent, Progress, ProgressLine, cosine_rate, silent, soap


def train_autoencoder(
    training: Dataset,
    variant: str,
    latent_dim: int,
    seed: int,
    settings: AutoencoderSettings,
    progress: Progress = silent,
) -> Autoencoder:
    """Train one autoencoder on the training split; the same arguments give the same bytes.

    Raises InputError for an unknown variant and for a trajectory that cannot be learned from,
    NumericalError when the training diverges; both name the trajectory.
    """
    training.require_sound()
    count = settings.samples_per_trajectory
    residuals = path_even_residuals(training, count)
    basis = modal_basis(residuals, settings.modes_per_parity, settings.modes_per_parity)
    model = Autoencoder(variant, latent_dim, basis, Scales.of(training), settings, seed)
    terminal = np.stack([trajectory.terminal.ravel() for trajectory in training])
    columns = [
        basis.coefficients(residuals),
        np.repeat([[model.scales.log_B(trajectory.B)] for trajectory in training], count, axis=0),
        np.repeat(basis.coefficients(terminal / model.scales.half_length), count, axis=0),
    ]
    tensors = tuple(torch.tensor(column, dtype=torch.float32) for column in columns)
    _fit(model, tensors, training.names, seed, progress)
    return model


def path_even_residuals(training: Dataset, count: int) -> Array:
    """Residual shapes (S count, 3N), ``count`` of each trajectory, even along its path."""
    scales = Scales.of(training)
    residuals = [
        residual_history(trajectory, scales)[path_even_indices(trajectory, scales, count)] for trajectory in training
    ]
    return np.concatenate(residuals)


def _fit(model: Autoencoder, columns: tuple[Tensor, ...], names: list[str], seed: int, progress: Progress) -> None:
    settings = model.settings
    generator = torch.Generator().manual_seed(seed)
    name = f"autoencoder {model.variant}, d = {model.latent_dim}"
    descent = Descent(soap(model.parameters()), names, name, progress)
    line = ProgressLine(name, settings.iterations, progress)
    for step in range(settings.iterations):
        rows = torch.randint(len(columns[0]), (settings.batch_size,), generator=generator)
        rate = cosine_rate(settings.learning_rate, step, settings.iterations)
        errors = squared_errors(model, *(column[rows] for column in columns))
        line.update(step, descent.step(rate, errors.mean(), errors, rows // settings.samples_per_trajectory))


def squared_errors(model: Autoencoder, z: Tensor, b: Tensor, terminal: Tensor) -> Tensor:
    """‖z − ž‖² of each sample (S,): modal coefficients of residual and terminal shapes (S, r)."""
    context = model.context(b, terminal)
    return (model.decode_modal(model.encode_modal(z, context), context) - z).square().sum(dim=1)
