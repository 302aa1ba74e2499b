"""``sedfiber train_node``: the neural ODE on a trained autoencoder, together a forecast model."""

from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path

import torch

from sedfiber.commands.steps._data import say
from sedfiber.commands.steps._step import Folder, Split, made_from
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


def run(training: Split, *, autoencoder: Path, output: Folder, recipe: str, seed: int, settings: Mapping) -> None:
    """Train on a trained autoencoder and write a folder that holds all that a forecast needs."""
    torch.set_num_threads(1)
    train, kind = RECIPES[one_of("recipe", recipe, RECIPES)]
    seed, chosen = whole_number("seed", seed, "a whole number from 0 up"), made_from(settings, kind, "settings")
    encoder, falls = load_autoencoder(autoencoder), read_dataset(*training)
    node = train(falls, encoder, seed, chosen, say)
    notes = {"recipe": recipe, "trajectories": len(falls), "node_settings": asdict(chosen)}
    save_forecast_model(ForecastModel(encoder, node, chosen.rtol, chosen.atol), output, notes)
