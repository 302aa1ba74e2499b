"""``sedfiber measure_model_growth``: simulation against forecast at another number of beads."""

import argparse
from pathlib import Path

import pandas as pd
import torch

from sedfiber.commands.steps._training import settings_of
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import whole_number
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index
from sedfiber.study.costs.model_growth import SmallStudy, measure_model_growth


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The number of beads, the falls to train on, the one to ask, and the trainings."""
    parser.add_argument("--n-beads", required=True, help="odd number of beads")
    parser.add_argument("--B", nargs=2, required=True, help="the two elasto-gravitational numbers to train on")
    parser.add_argument("--angle-index", nargs="+", required=True, help="k in θ0 = k π/48 to train on")
    parser.add_argument("--asked-index", required=True, help="k to ask, at the ℬ between the two")
    parser.add_argument("--latent-dim", required=True, help="latent dimension d")
    parser.add_argument("--autoencoder-settings", default="{}", help="JSON object of hyper-parameters (the defaults)")
    parser.add_argument("--node-settings", default="{}", help="JSON object of hyper-parameters (the defaults)")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Simulate, train, measure and write a row a choice."""
    torch.set_num_threads(1)
    low, high = (Scene(B, 0.0, args.n_beads) for B in args.B)
    study = SmallStudy(
        (low.B, high.B),
        tuple(angle_index(k) for k in args.angle_index),
        angle_index(args.asked_index),
        whole_number("latent_dim", args.latent_dim, "a whole number from 1 up", 1),
        settings_of(args.autoencoder_settings, AutoencoderSettings, "autoencoder_settings"),
        settings_of(args.node_settings, NodeSettings, "node_settings"),
    )
    require_writable(args.output)
    table = pd.DataFrame(measure_model_growth(low.n_beads, study))
    print(table[["family", "tolerance", "batch", "precision", "error", "seconds_least"]].to_string(index=False))
    write_csv(table, args.output)
