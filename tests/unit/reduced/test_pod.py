import numpy as np
import pytest

from sedfiber.reduced.dataset import mirrored
from sedfiber.reduced.pod import modal_basis, pod_basis
from sedfiber.reduced.training.train_autoencoder import path_even_residuals
from tiny_fiber import N_BEADS


@pytest.fixture
def residuals(training):
    return path_even_residuals(training, 12)


def test_modes_are_orthonormal(residuals):
    basis = modal_basis(residuals, 2, 2)
    np.testing.assert_allclose(basis.modes @ basis.modes.T, np.eye(4), atol=1e-12)


def test_modes_have_the_parity_they_claim(residuals):
    basis = modal_basis(residuals, 2, 2)
    images = mirrored(basis.modes.reshape(4, N_BEADS, 3)).reshape(4, -1)
    np.testing.assert_allclose(images, basis.signs[:, None] * basis.modes, atol=1e-10)


def test_modes_without_energy_are_left_out(residuals):
    basis = modal_basis(residuals, 12, 12)
    assert len(basis.modes) < 2 * N_BEADS
    np.testing.assert_allclose(basis.reconstruct(basis.coefficients(residuals)), residuals, atol=1e-6)


def test_loss_is_the_energy_left_out(residuals):
    both = np.concatenate([residuals, mirrored(residuals.reshape(-1, N_BEADS, 3)).reshape(residuals.shape)])
    basis = pod_basis(residuals, 2)
    loss = ((both - basis.reconstruct(basis.coefficients(both))) ** 2).sum(axis=1).mean()
    total = (both**2).sum(axis=1).mean()
    assert loss == pytest.approx(total - basis.energies.sum(), rel=1e-9)


def test_more_modes_lose_less(residuals):
    def loss(d):
        basis = pod_basis(residuals, d)
        return ((residuals - basis.reconstruct(basis.coefficients(residuals))) ** 2).sum()

    losses = [loss(d) for d in range(1, 6)]
    assert losses == sorted(losses, reverse=True)
