"""``sedfiber measure_models``: training time, size, error and speed of every variant and latent dimension."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import torch

from sedfiber.commands.steps._benchmark_files import seconds_of
from sedfiber.commands.steps._data import read_splits
from sedfiber.commands.steps._step import Output, Splits, made_from
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.core.validation import whole_number
from sedfiber.simulation.equilibria.terminal_curve import read_terminal_curve
from sedfiber.study.costs.models import Trained, measure_models
from sedfiber.study.costs.queries import stored_queries


def run(
    tests: Splits, *, reconstruction: Path, terminal_curve: Path, output: Output, models: Sequence[Mapping]
) -> None:
    """Forecast every test trajectory with every model, print the largest errors, write a row a model and set.

    ``reconstruction`` is the table of losses, ``terminal_curve`` that of the whole range of ℬ.
    """
    torch.set_num_threads(1)
    trained = [made_from(model, _trained, "models") for model in models]
    curve, losses = read_terminal_curve(terminal_curve), read_csv(reconstruction)
    asked = [query for split in read_splits(tests) for query in stored_queries(split, curve.hydrodynamics)]
    table = measure_models(trained, asked, losses, curve)
    columns = ["variant", "latent_dim", "seed", "recipe", "training_seconds", "test_set", "E_worst", "E_median"]
    print(table[columns].to_string(index=False))
    write_csv(table, output)


def _trained(recipe: str, seed: int, folder: str, benchmarks: Sequence[str]) -> Trained:
    """A forecast model and the benchmark files of its trainings."""
    seconds = seconds_of(map(Path, benchmarks))
    return Trained(Path(folder), recipe, whole_number("seed", seed, "a whole number from 0 up"), seconds)
