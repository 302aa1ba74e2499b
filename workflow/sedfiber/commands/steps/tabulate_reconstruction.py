"""``sedfiber tabulate_reconstruction``: reconstruction loss of every autoencoder, and of POD."""

import argparse
from pathlib import Path

import pandas as pd
import torch

from sedfiber.commands.steps._training import add_data_arguments
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_files import load_autoencoder
from sedfiber.study.reconstruction_table import reconstruction_rows


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The models, the training split (for POD) and the test splits."""
    add_data_arguments(parser)
    parser.add_argument("--models", nargs="+", type=Path, required=True, help="folders of autoencoders")
    parser.add_argument("--test-datasets", nargs="+", type=Path, required=True, help="Parquet files of test splits")
    parser.add_argument("--test-shapes", nargs="+", type=Path, required=True, help="their steady shapes, in order")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """One row per model and test set, then POD with the same dimensions."""
    torch.set_num_threads(1)
    require_writable(args.output)
    training = read_dataset(args.dataset, args.terminal_shapes)
    tests = [read_dataset(*pair) for pair in zip(args.test_datasets, args.test_shapes, strict=True)]
    models = [load_autoencoder(folder) for folder in args.models]
    table = pd.DataFrame(reconstruction_rows(models, training, tests))
    write_csv(table.astype({"seed": "Int64"}), args.output)  # POD has none
