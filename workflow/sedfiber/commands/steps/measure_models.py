"""``sedfiber measure_models``: training time, size, error and speed of every variant and latent dimension."""

import argparse
from pathlib import Path

import torch

from sedfiber.commands.steps._benchmark_files import seconds_of
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.core.errors import InputError
from sedfiber.core.validation import whole_number
from sedfiber.reduced.dataset import read_dataset
from sedfiber.simulation.equilibria.terminal_curve import read_terminal_curve
from sedfiber.study.costs.models import Trained, measure_models
from sedfiber.study.costs.queries import stored_queries


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Models with what they took to train, the test sets, and the reconstruction losses."""
    parser.add_argument(
        "--model",
        nargs="+",
        action="append",
        required=True,
        metavar=("RECIPE SEED FOLDER", "BENCHMARK"),
        help="a forecast model and the benchmark files of its trainings; once for each",
    )
    parser.add_argument(
        "--test",
        nargs=2,
        type=Path,
        action="append",
        required=True,
        metavar=("DATASET", "TERMINAL_SHAPES"),
        help="a test split; once for each",
    )
    parser.add_argument("--reconstruction", type=Path, required=True, help="CSV table of reconstruction losses")
    parser.add_argument("--terminal-curve", type=Path, required=True, help="terminal shapes of the whole range")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Forecast every test trajectory with every model, print the largest errors, write a row a model and set."""
    torch.set_num_threads(1)
    models = [_trained(words) for words in args.model]
    require_writable(args.output)
    curve, reconstruction = read_terminal_curve(args.terminal_curve), read_csv(args.reconstruction)
    asked = [query for split in args.test for query in stored_queries(read_dataset(*split), curve.hydrodynamics)]
    table = measure_models(models, asked, reconstruction, curve)
    columns = ["variant", "latent_dim", "seed", "recipe", "training_seconds", "test_set", "E_worst", "E_median"]
    print(table[columns].to_string(index=False))
    write_csv(table, args.output)


def _trained(words: list[str]) -> Trained:
    if len(words) < 3:
        raise InputError(f"model: {' '.join(words)!r} is not allowed; give a recipe, a seed and a folder")
    recipe, seed, folder, *files = words
    seconds = seconds_of(Path(file) for file in files)
    return Trained(Path(folder), recipe, whole_number("seed", seed, "a whole number from 0 up"), seconds)
