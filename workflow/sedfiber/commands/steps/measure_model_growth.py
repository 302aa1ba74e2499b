"""``sedfiber measure_model_growth``: simulation against forecast at another number of beads."""

from collections.abc import Mapping, Sequence

import pandas as pd
import torch

from sedfiber.commands.steps._step import Output, made_from
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import whole_number
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings
from sedfiber.scene.scene import Scene
from sedfiber.study.angles import angle_index as index_of
from sedfiber.study.costs.model_growth import SmallStudy, measure_model_growth


def run(
    *,
    output: Output,
    n_beads: int,
    B: Sequence[float],  # two, to train on; the one between is forecast
    angle_index: Sequence[int],  # to train on
    asked_index: int,
    latent_dim: int,
    autoencoder: Mapping,
    node: Mapping,
) -> None:
    """Simulate, train, measure and write a row a choice."""
    torch.set_num_threads(1)
    low, high = (Scene(one, 0.0, n_beads) for one in B)
    study = SmallStudy(
        (low.B, high.B),
        tuple(index_of(k) for k in angle_index),
        index_of(asked_index),
        whole_number("latent_dim", latent_dim, "a whole number from 1 up", 1),
        made_from(autoencoder, AutoencoderSettings, "autoencoder"),
        made_from(node, NodeSettings, "node"),
    )
    table = pd.DataFrame(measure_model_growth(low.n_beads, study))
    print(table[["family", "tolerance", "batch", "precision", "error", "seconds_least"]].to_string(index=False))
    write_csv(table, output)
