"""``sedfiber measure_models``: training time, size, error and speed of every variant and latent dimension."""

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path

import torch

from sedfiber.commands.steps._benchmark_files import seconds_of
from sedfiber.commands.steps._data import add_splits, read_splits
from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.core.validation import whole_number
from sedfiber.simulation.equilibria.terminal_curve import read_terminal_curve
from sedfiber.study.costs.models import Trained, measure_models
from sedfiber.study.costs.queries import stored_queries


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Models with what they took to train, the test sets, and the reconstruction losses."""
    add_splits(parser, "tests", "test splits")
    parser.add_argument("--reconstruction", type=Path, required=True, help="CSV table of reconstruction losses")
    parser.add_argument("--terminal-curve", type=Path, required=True, help="terminal shapes of the whole range")
    add_settings_and_output(parser, "CSV file to write")


def run(args: argparse.Namespace) -> None:
    """Forecast every test trajectory with every model, print the largest errors, write a row a model and set."""
    torch.set_num_threads(1)
    models = made_from(args.settings, _trained)
    require_writable(args.output)
    curve, reconstruction = read_terminal_curve(args.terminal_curve), read_csv(args.reconstruction)
    asked = [query for split in read_splits(args.tests) for query in stored_queries(split, curve.hydrodynamics)]
    table = measure_models(models, asked, reconstruction, curve)
    columns = ["variant", "latent_dim", "seed", "recipe", "training_seconds", "test_set", "E_worst", "E_median"]
    print(table[columns].to_string(index=False))
    write_csv(table, args.output)


def _trained(models: Sequence[Mapping]) -> list[Trained]:
    return [made_from(model, _one, "models") for model in models]


def _one(recipe: str, seed: int, folder: str, benchmarks: Sequence[str]) -> Trained:
    """A forecast model and the benchmark files of its trainings."""
    seconds = seconds_of(map(Path, benchmarks))
    return Trained(Path(folder), recipe, whole_number("seed", seed, "a whole number from 0 up"), seconds)
