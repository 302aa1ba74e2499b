"""``sedfiber train_autoencoder``: one autoencoder of one variant and latent dimension."""

from collections.abc import Mapping
from dataclasses import asdict

import torch

from sedfiber.commands.steps._data import say
from sedfiber.commands.steps._step import Folder, Split, made_from
from sedfiber.core.validation import one_of, whole_number
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import save_autoencoder
from sedfiber.reduced.training.settings import VARIANTS, AutoencoderSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder


def run(training: Split, *, output: Folder, variant: str, latent_dim: int, seed: int, settings: Mapping) -> None:
    """Train on the whole split and write the model folder; ``settings`` are the hyper-parameters."""
    torch.set_num_threads(1)
    dim = whole_number("latent_dim", latent_dim, "a whole number from 1 up", 1)
    seed = whole_number("seed", seed, "a whole number from 0 up")
    variant, chosen = one_of("variant", variant, VARIANTS), made_from(settings, AutoencoderSettings, "settings")
    falls = read_dataset(*training)
    model = train_autoencoder(falls, variant, dim, seed, chosen, say)
    save_autoencoder(model, output, {"trajectories": len(falls), "settings": asdict(chosen)})
