import numpy as np
import pytest
import torch

from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.dataset import Dataset, mirrored
from sedfiber.reduced.pod import pod_basis
from sedfiber.reduced.reconstruction import autoencoder_errors, mean_over_samples, pod_errors
from sedfiber.reduced.training.settings import VARIANTS, AutoencoderSettings
from sedfiber.reduced.training.train_autoencoder import path_even_residuals, train_autoencoder
from tiny_fiber import N_BEADS, training_set

QUICK = AutoencoderSettings(
    decoder_hidden=(12,), encoder_hidden=4, modes_per_parity=4, samples_per_trajectory=12, batch_size=64, iterations=60
)


@pytest.fixture(params=VARIANTS, scope="module")
def model(request):
    """One of each variant, its weights frozen."""
    return train_autoencoder(training_set(), request.param, 3, 0, QUICK).double().requires_grad_(False)


@pytest.fixture
def shapes(training):
    return torch.tensor(path_even_residuals(training, 4))


def contexts(shift=0.0):
    """[b, h_term] of 48 samples, h_term symmetric: its odd components, the first two, vanish."""
    b = torch.linspace(-1, 1, 48, dtype=torch.float64)[:, None]
    return torch.cat([b + shift, 0 * b, 0 * b, 0.3 * b + shift], dim=1)


CONTEXT = contexts()


def test_terminal_shape_is_encoded_as_zero_and_decoded_from_zero(model):
    zero = torch.zeros(5, 3 * N_BEADS, dtype=torch.float64)
    assert model.encode(zero, CONTEXT[:5]).abs().max() == 0
    assert model.decode(torch.zeros(5, 3, dtype=torch.float64), CONTEXT[:5]).abs().max() < 1e-12


def test_mirror_image_is_reconstructed_as_the_mirror_image(model, shapes):
    def mirror(flat):
        return torch.tensor(mirrored(flat.numpy().reshape(-1, N_BEADS, 3)).reshape(flat.shape))

    rebuilt = model.decode(model.encode(shapes, CONTEXT), CONTEXT)
    torch.testing.assert_close(
        model.decode(model.encode(mirror(shapes), CONTEXT), CONTEXT), mirror(rebuilt), atol=1e-6, rtol=0
    )


def test_variant_says_who_sees_B(model, shapes):
    h = model.encode(shapes, CONTEXT)
    assert (h != model.encode(shapes, contexts(0.5))).any() == (model.variant in ("encoder", "double"))
    assert (model.decode(h, CONTEXT) != model.decode(h, contexts(0.5))).any() == (
        model.variant in ("decoder", "double")
    )


def test_learns_more_than_pod_of_the_same_dimension(training):
    model = train_autoencoder(
        training,
        "decoder",
        2,
        0,
        AutoencoderSettings(
            decoder_hidden=(16,), modes_per_parity=4, samples_per_trajectory=12, batch_size=64, iterations=400
        ),
    )
    basis = pod_basis(path_even_residuals(training, 12), 2)
    learned = mean_over_samples([autoencoder_errors(model, one) for one in training])
    linear = mean_over_samples([pod_errors(basis, model.scales, one) for one in training])
    assert learned < 0.7 * linear


def test_same_seed_gives_the_same_bytes(training):
    first, second, other = (train_autoencoder(training, "double", 2, seed, QUICK).state_dict() for seed in (7, 7, 8))
    assert all(first[name].numpy().tobytes() == second[name].numpy().tobytes() for name in first)
    assert any((first[name] != other[name]).any() for name in first)


def test_unknown_variant_is_refused(training):
    with pytest.raises(InputError, match="'both'"):
        train_autoencoder(training, "both", 2, 0, QUICK)


def test_latent_dimension_beyond_the_modes_is_refused(training):
    with pytest.raises(InputError, match="latent dimension 20"):
        train_autoencoder(training, "none", 20, 0, QUICK)


def test_loss_that_is_not_finite_stops_the_training(training):
    huge = list(training)
    huge[0].positions[5] *= 1e30
    with pytest.raises(NumericalError, match="autoencoder decoder, d = 2"):
        train_autoencoder(Dataset(tuple(huge)), "decoder", 2, 0, QUICK)


def test_progress_ends_with_a_line(training):
    lines = []
    train_autoencoder(training, "none", 1, 0, QUICK, lines.append)
    assert "step 60/60" in lines[-1] and np.all(["loss" in line for line in lines])
