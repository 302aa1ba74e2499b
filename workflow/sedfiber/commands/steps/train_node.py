"""``sedfiber train_node``: the neural ODE on a trained autoencoder, together a forecast model."""

import argparse
from dataclasses import asdict
from pathlib import Path

import torch

from sedfiber.commands.steps._training import add_training_arguments, say, seed_of, settings_of
from sedfiber.core.atomic_file import require_folder
from sedfiber.core.validation import one_of
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import load_autoencoder, save_forecast_model
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import NodeSettings, SourceNodeSettings
from sedfiber.reduced.training.train_node import train_node
from sedfiber.reduced.training.train_node_source import train_node_source

RECIPES = {"rollout": (train_node, NodeSettings), "source": (train_node_source, SourceNodeSettings)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Data, autoencoder, recipe, seed and settings."""
    add_training_arguments(parser)
    parser.add_argument("--autoencoder", type=Path, required=True, help="folder of a trained autoencoder")
    parser.add_argument("--recipe", required=True, help=f"how to train: {', '.join(RECIPES)}")


def run(args: argparse.Namespace) -> None:
    """Train and write a folder that holds all that a forecast needs."""
    torch.set_num_threads(1)
    train, kind = RECIPES[one_of("recipe", args.recipe, RECIPES)]
    seed, settings = seed_of(args), settings_of(args.settings, kind)
    autoencoder = load_autoencoder(args.autoencoder)
    training = read_dataset(args.dataset, args.terminal_shapes)
    require_folder(args.output)
    node = train(training, autoencoder, seed, settings, say)
    notes = {"recipe": args.recipe, "trajectories": len(training), "node_settings": asdict(settings)}
    save_forecast_model(ForecastModel(autoencoder, node, settings.rtol, settings.atol), args.output, notes)
