"""Reconstruction loss of autoencoders and of POD with as many modes, by test set."""

from collections.abc import Callable
from functools import partial

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import Dataset, SettlingFall
from sedfiber.reduced.pod import pod_basis
from sedfiber.reduced.reconstruction import autoencoder_errors, mean_over_samples, pod_errors
from sedfiber.reduced.scaling import Scales
from sedfiber.reduced.training.sampling import path_even_indices
from sedfiber.reduced.training.train_autoencoder import path_even_residuals


def reconstruction_rows(models: list[Autoencoder], training: Dataset, tests: list[Dataset]) -> list[dict]:
    """One row per method, dimension and test set.

    ``loss`` is ⟨‖X̌ − D(E(X̌))‖²⟩ over the stored samples (units L/2, summed over the
    coordinates), ``loss_path_even`` the same over samples even along each path.
    """
    rows = []
    for model in models:
        labels = {"method": "autoencoder", "variant": model.variant, "seed": model.seed}
        count = model.settings.samples_per_trajectory
        measure = _measure(partial(autoencoder_errors, model), model.scales, count)
        rows += [{**labels, "latent_dim": model.latent_dim, **measure(test)} for test in tests]
    return rows + _pod_rows(models, training, tests)


def _pod_rows(models: list[Autoencoder], training: Dataset, tests: list[Dataset]) -> list[dict]:
    scales, count = Scales.of(training), models[0].settings.samples_per_trajectory
    residuals = path_even_residuals(training, count)
    rows = []
    for d in sorted({model.latent_dim for model in models}):
        basis = pod_basis(residuals, d)
        measure = _measure(partial(pod_errors, basis, scales), scales, count)
        rows += [{"method": "pod", "variant": None, "seed": None, "latent_dim": d, **measure(test)} for test in tests]
    return rows


def _measure(errors: Callable[[SettlingFall], Array], scales: Scales, count: int) -> Callable[[Dataset], dict]:
    def measure(test: Dataset) -> dict:
        stored = [errors(one) for one in test]
        even = [e[path_even_indices(one, scales, count)] for e, one in zip(stored, test, strict=True)]
        return {
            "test_set": next(iter(test)).split,
            "loss": mean_over_samples(stored),
            "loss_path_even": mean_over_samples(even),
            "loss_worst_sample": float(np.concatenate(stored).max()),
        }

    return measure
