"""Training of an autoencoder: the reconstruction loss ⟨‖X̌ − D(E(X̌; ℬ); ℬ)‖²⟩.

The modes are orthonormal and fixed, so the loss is taken on modal coefficients; what the
modes leave out does not depend on the weights.
"""

import numpy as np
import torch
from torch import Tensor

from sedfiber._typing import Array
from sedfiber.learning.autoencoder import Autoencoder
from sedfiber.learning.dataset import Dataset
from sedfiber.learning.optimiser import Soap
from sedfiber.learning.pod import modal_basis
from sedfiber.learning.sampling import path_even_indices
from sedfiber.learning.scaling import Scales, residual_history
from sedfiber.learning.settings import AutoencoderSettings
from sedfiber.learning.training import Progress, ProgressLine, cosine_rate, descend, silent


def train_autoencoder(
    training: Dataset,
    variant: str,
    latent_dim: int,
    seed: int,
    settings: AutoencoderSettings,
    progress: Progress = silent,
) -> Autoencoder:
    """Train one autoencoder on the training split; the same arguments give the same bytes.

    Raises InputError for an unknown variant, NumericalError when the loss is not finite.
    """
    residuals, b = path_even_residuals(training, settings.samples_per_trajectory)
    basis = modal_basis(residuals, settings.modes_per_parity, settings.modes_per_parity)
    model = Autoencoder(variant, latent_dim, basis, Scales.of(training), settings, seed)
    z = torch.tensor(basis.coefficients(residuals), dtype=torch.float32)
    _fit(model, z, torch.tensor(b, dtype=torch.float32), seed, progress)
    return model


def path_even_residuals(training: Dataset, count: int) -> tuple[Array, Array]:
    """Residual shapes (S, 3N) and scaled ln ℬ (S, 1) of all trajectories, even along paths."""
    scales = Scales.of(training)
    residuals = [
        residual_history(trajectory, scales)[path_even_indices(trajectory, scales, count)] for trajectory in training
    ]
    b = np.repeat([scales.log_B(trajectory.B) for trajectory in training], count)
    return np.concatenate(residuals), b[:, None]


def _fit(model: Autoencoder, z: Tensor, b: Tensor, seed: int, progress: Progress) -> None:
    settings = model.settings
    generator = torch.Generator().manual_seed(seed)
    optimiser = Soap(model.parameters())
    name = f"autoencoder {model.variant}, d = {model.latent_dim}"
    line = ProgressLine(name, settings.iterations, progress)
    for step in range(settings.iterations):
        rows = torch.randint(len(z), (settings.batch_size,), generator=generator)
        optimiser.learning_rate = cosine_rate(settings.learning_rate, step, settings.iterations)
        loss = descend(optimiser, reconstruction_loss(model, z[rows], b[rows]), name)
        line.update(step, loss)


def reconstruction_loss(model: Autoencoder, z: Tensor, b: Tensor) -> Tensor:
    """⟨‖z − ž‖²⟩ over a batch of modal coefficients (S, r)."""
    return (model.decode_modal(model.encode_modal(z, b), b) - z).square().sum(dim=1).mean()
