"""``sedfiber train_node``: the neural ODE on a trained autoencoder, together a forecast model."""

import argparse
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path

import torch

from sedfiber.commands.steps._data import add_split, say
from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_folder
from sedfiber.core.validation import one_of, whole_number
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import load_autoencoder, save_forecast_model
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import NodeSettings, SourceNodeSettings
from sedfiber.reduced.training.train_node import train_node
from sedfiber.reduced.training.train_node_source import train_node_source

RECIPES: dict[str, tuple[Callable, type]] = {
    "rollout": (train_node, NodeSettings),
    "source": (train_node_source, SourceNodeSettings),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Data, autoencoder, settings and the model."""
    add_split(parser, "training", "the training split")
    add_settings_and_output(parser, "folder of the model")
    parser.add_argument("--autoencoder", type=Path, required=True, help="folder of a trained autoencoder")


def run(args: argparse.Namespace) -> None:
    """Train and write a folder that holds all that a forecast needs."""
    torch.set_num_threads(1)
    recipe, seed, settings = made_from(args.settings, _asked)
    autoencoder = load_autoencoder(args.autoencoder)
    training = read_dataset(*args.training)
    require_folder(args.output)
    node = RECIPES[recipe][0](training, autoencoder, seed, settings, say)
    notes = {"recipe": recipe, "trajectories": len(training), "node_settings": asdict(settings)}
    save_forecast_model(ForecastModel(autoencoder, node, settings.rtol, settings.atol), args.output, notes)


def _asked(recipe: str, seed: int, settings: Mapping) -> tuple[str, int, NodeSettings | SourceNodeSettings]:
    """How to train, what draws weights and batches, the hyper-parameters."""
    kind = RECIPES[one_of("recipe", recipe, RECIPES)][1]
    return recipe, whole_number("seed", seed, "a whole number from 0 up"), made_from(settings, kind)
