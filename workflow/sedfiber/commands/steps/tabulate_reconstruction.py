"""``sedfiber tabulate_reconstruction``: reconstruction loss of every autoencoder, and of POD."""

from pathlib import Path

import pandas as pd
import torch

from sedfiber.commands.steps._data import read_splits
from sedfiber.commands.steps._step import Output, Split, Splits
from sedfiber.core.csv_file import write_csv
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import load_autoencoder
from sedfiber.study.reconstruction_table import reconstruction_rows


def run(training: Split, *, models: list[Path], tests: Splits, output: Output) -> None:
    """One row for each autoencoder and test set, then POD, from the training split, with the same dimensions."""
    torch.set_num_threads(1)
    trained = [load_autoencoder(folder) for folder in models]
    table = pd.DataFrame(reconstruction_rows(trained, read_dataset(*training), read_splits(tests)))
    write_csv(table.astype({"seed": "Int64"}), output)  # POD has none
