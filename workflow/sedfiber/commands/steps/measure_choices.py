"""``sedfiber measure_choices``: simulations, forecasts, lookup and POD–Galerkin on the test trajectories."""

import argparse
from pathlib import Path

import torch

from sedfiber.commands.steps._benchmark_files import seconds_of
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.core.validation import number_within, whole_number
from sedfiber.reduced.dataset import Dataset, read_dataset
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, read_terminal_curve
from sedfiber.study.costs.choice import Outcomes
from sedfiber.study.costs.choice_tables import choices_at_each_B, choices_overall
from sedfiber.study.costs.choices import measure_single, measure_sweeps
from sedfiber.study.costs.contestants import (
    compiled_forecasts,
    forecasters,
    galerkins,
    lookups,
    simulations,
    torch_forecast,
)
from sedfiber.study.costs.machine import machine_columns
from sedfiber.study.costs.queries import Query, queries


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Data, models with what they took to make, and what to try."""
    data = {"nargs": 2, "type": Path, "metavar": ("DATASET", "TERMINAL_SHAPES")}
    parser.add_argument("--training", **data, required=True, help="the training split")
    parser.add_argument("--test", **data, action="append", required=True, help="a test split; once for each")
    parser.add_argument("--terminal-curve", type=Path, required=True, help="terminal shapes of the whole range")
    parser.add_argument(
        "--model",
        nargs="+",
        action="append",
        required=True,
        metavar=("NAME FOLDER", "BENCHMARK"),
        help="a forecast model and the benchmark files of its trainings; once for each",
    )
    parser.add_argument("--data-benchmarks", nargs="*", type=Path, default=[], help="those of making the training set")
    parser.add_argument("--simulation-tolerances", nargs="+", required=True, help="relative, and absolute in a")
    parser.add_argument("--forecast-tolerances", nargs="+", required=True, help="relative, and absolute in L/2")
    parser.add_argument("--pod-modes", nargs="+", required=True, help="numbers of modes of POD-Galerkin")
    parser.add_argument("--batches", nargs="+", required=True, help="numbers of forecasts at once")
    parser.add_argument("--batch-tolerances", nargs="+", required=True, help="relative, and absolute in L/2, of those")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write: one row a choice")
    parser.add_argument("--at-each-B", type=Path, required=True, help="CSV file to write: one row a choice and ℬ")


def run(args: argparse.Namespace) -> None:
    """Ask everything every query, then write both tables."""
    torch.set_num_threads(1)
    models = {name: (Path(folder), [Path(file) for file in files]) for name, folder, *files in _models(args.model)}
    ladders = _ladders(args)
    for path in (args.output, args.at_each_B):
        require_writable(path)
    data = seconds_of(args.data_benchmarks)
    preparation = {name: data + seconds_of(files) for name, (_, files) in models.items()}
    training, curve = read_dataset(*args.training), read_terminal_curve(args.terminal_curve)
    asked = [query for split in args.test for query in queries(read_dataset(*split), curve.hydrodynamics)]
    found = _measure(asked, training, {name: folder for name, (folder, _) in models.items()}, curve, ladders)
    facts = machine_columns()
    write_csv(choices_at_each_B(found, asked, preparation, data).assign(**facts), args.at_each_B)
    write_csv(choices_overall(found, preparation, data).assign(**facts), args.output)


def _measure(
    asked: list[Query], training: Dataset, models: dict[str, Path], curve: TerminalCurve, ladders: dict[str, list]
) -> Outcomes:
    """What is fast is asked everything; POD-Galerkin one query of each ℬ; the last model through torch the last."""
    found, n_beads = Outcomes(), training.n_beads
    at = {name: forecasters(folder, ladders["forecast_tolerances"], curve) for name, folder in models.items()}
    contestants = [*simulations(ladders["simulation_tolerances"], n_beads), *lookups(training)]
    measure_single(asked, contestants + [one for name in models for one in compiled_forecasts(name, at[name])], found)
    of_each_B = list({query.B: query for query in asked}.values())
    measure_single(of_each_B, galerkins(training, ladders["pod_modes"]), found)
    name, folder = list(models.items())[-1]
    measure_single(of_each_B[-1:], [torch_forecast(name, folder, next(iter(at[name].values())))], found)
    for name, folder in models.items():
        measure_sweeps(asked, name, forecasters(folder, ladders["batch_tolerances"], curve), ladders["batches"], found)
    return found


def _models(given: list[list[str]]) -> list[list[str]]:
    for words in given:
        if len(words) < 2:
            raise InputError(f"model: {' '.join(words)!r} is not allowed; give a name and a folder")
    return given


def _ladders(args: argparse.Namespace) -> dict[str, list]:
    """The validated lists of what to try."""
    found: dict[str, list] = {}
    for key in ("simulation_tolerances", "forecast_tolerances", "batch_tolerances"):
        allowed = "numbers from 1e-12 to 0.1"
        found[key] = [number_within(key, value, 1e-12, 0.1, allowed) for value in getattr(args, key)]
    for key in ("pod_modes", "batches"):
        found[key] = [whole_number(key, value, "whole numbers from 1 up", 1) for value in getattr(args, key)]
    return found
