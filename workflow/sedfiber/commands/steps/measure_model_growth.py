"""``sedfiber measure_model_growth``: simulation against forecast at another number of beads."""

import argparse
from collections.abc import Mapping, Sequence

import pandas as pd
import torch

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import whole_number
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index as index_of
from sedfiber.study.costs.model_growth import SmallStudy, measure_model_growth


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The number of beads, the falls to train on, the one to ask, and the trainings."""
    add_settings_and_output(parser, "CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Simulate, train, measure and write a row a choice."""
    torch.set_num_threads(1)
    n_beads, study = made_from(args.settings, _asked)
    require_writable(args.output)
    table = pd.DataFrame(measure_model_growth(n_beads, study))
    print(table[["family", "tolerance", "batch", "precision", "error", "seconds_least"]].to_string(index=False))
    write_csv(table, args.output)


def _asked(
    n_beads: int,
    B: Sequence[float],  # two, to train on; the one between is asked
    angle_index: Sequence[int],  # to train on
    asked_index: int,
    latent_dim: int,
    autoencoder: Mapping,
    node: Mapping,
) -> tuple[int, SmallStudy]:
    low, high = (Scene(one, 0.0, n_beads) for one in B)
    study = SmallStudy(
        (low.B, high.B),
        tuple(index_of(k) for k in angle_index),
        index_of(asked_index),
        whole_number("latent_dim", latent_dim, "a whole number from 1 up", 1),
        made_from(autoencoder, AutoencoderSettings, "autoencoder"),
        made_from(node, NodeSettings, "node"),
    )
    return low.n_beads, study
