"""``sedfiber tabulate_reconstruction``: reconstruction loss of every autoencoder, and of POD."""

import argparse
from pathlib import Path

import pandas as pd
import torch

from sedfiber.commands.steps._data import add_split, add_splits, read_splits
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import load_autoencoder
from sedfiber.study.reconstruction_table import reconstruction_rows


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The models, the training split (for POD) and the test splits."""
    add_split(parser, "training", "the training split")
    parser.add_argument("--models", nargs="+", type=Path, required=True, help="folders of autoencoders")
    add_splits(parser, "--tests", "test splits")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """One row per model and test set, then POD with the same dimensions."""
    torch.set_num_threads(1)
    require_writable(args.output)
    training = read_dataset(*args.training)
    tests = read_splits(args.tests)
    models = [load_autoencoder(folder) for folder in args.models]
    table = pd.DataFrame(reconstruction_rows(models, training, tests))
    write_csv(table.astype({"seed": "Int64"}), args.output)  # POD has none
