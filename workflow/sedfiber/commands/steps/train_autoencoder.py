"""``sedfiber train_autoencoder``: one autoencoder of one variant and latent dimension."""

import argparse
from dataclasses import asdict

import torch

from sedfiber.commands.steps._training import add_training_arguments, say, seed_of, settings_of
from sedfiber.core.atomic_file import require_folder
from sedfiber.core.validation import one_of, whole_number
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import save_autoencoder
from sedfiber.reduced.training.settings import VARIANTS, AutoencoderSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Data, variant, dimension, seed and settings."""
    add_training_arguments(parser)
    parser.add_argument("--variant", required=True, help=f"where ℬ enters: {', '.join(VARIANTS)}")
    parser.add_argument("--latent-dim", required=True, help="number of latent variables d")


def run(args: argparse.Namespace) -> None:
    """Train on the whole file and write the model folder."""
    torch.set_num_threads(1)
    variant = one_of("variant", args.variant, VARIANTS)
    latent_dim = whole_number("latent_dim", args.latent_dim, "a whole number from 1 up", 1)
    seed, settings = seed_of(args), settings_of(args.settings, AutoencoderSettings)
    training = read_dataset(args.dataset, args.terminal_shapes)
    require_folder(args.output)
    model = train_autoencoder(training, variant, latent_dim, seed, settings, say)
    save_autoencoder(model, args.output, {"trajectories": len(training), "settings": asdict(settings)})
