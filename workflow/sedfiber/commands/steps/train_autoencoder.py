"""``sedfiber train_autoencoder``: one autoencoder of one variant and latent dimension."""

import argparse
from collections.abc import Mapping
from dataclasses import asdict

import torch

from sedfiber.commands.steps._data import add_split, say
from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_folder
from sedfiber.core.validation import one_of, whole_number
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import save_autoencoder
from sedfiber.reduced.training.settings import VARIANTS, AutoencoderSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Data, settings and the model."""
    add_split(parser, "training", "the training split")
    add_settings_and_output(parser, "folder of the model")


def run(args: argparse.Namespace) -> None:
    """Train on the whole file and write the model folder."""
    torch.set_num_threads(1)
    variant, latent_dim, seed, settings = made_from(args.settings, _asked)
    training = read_dataset(*args.training)
    require_folder(args.output)
    model = train_autoencoder(training, variant, latent_dim, seed, settings, say)
    save_autoencoder(model, args.output, {"trajectories": len(training), "settings": asdict(settings)})


def _asked(variant: str, latent_dim: int, seed: int, settings: Mapping) -> tuple[str, int, int, AutoencoderSettings]:
    """Where ℬ enters, the number of latent variables, what draws weights and batches, the hyper-parameters."""
    dim = whole_number("latent_dim", latent_dim, "a whole number from 1 up", 1)
    seed = whole_number("seed", seed, "a whole number from 0 up")
    return one_of("variant", variant, VARIANTS), dim, seed, made_from(settings, AutoencoderSettings)
