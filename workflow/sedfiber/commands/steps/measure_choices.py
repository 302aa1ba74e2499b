"""``sedfiber measure_choices``: simulations, forecasts, lookup and POD–Galerkin on the test trajectories."""

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path

import torch

from sedfiber.commands.steps._benchmark_files import seconds_of
from sedfiber.commands.steps._data import add_split, add_splits, read_splits
from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.commands.steps._tolerances import tolerance_ladder
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import whole_number
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
    add_split(parser, "training", "the training split")
    add_splits(parser, "--tests", "test splits")
    parser.add_argument("--terminal-curve", type=Path, required=True, help="terminal shapes of the whole range")
    add_settings_and_output(parser, "CSV file to write: one row a choice")
    parser.add_argument("--at-each-B", type=Path, required=True, help="CSV file to write: one row a choice and ℬ")


def run(args: argparse.Namespace) -> None:
    """Ask everything every query, then write both tables."""
    torch.set_num_threads(1)
    for path in (args.output, args.at_each_B):
        require_writable(path)
    models, preparation, data, ladders = made_from(args.settings, _asked)
    training, curve = read_dataset(*args.training), read_terminal_curve(args.terminal_curve)
    asked = [query for split in read_splits(args.tests) for query in queries(split, curve.hydrodynamics)]
    found = _measure(asked, training, models, curve, ladders)
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


def _asked(
    models: Sequence[Mapping], data_benchmarks: Sequence[str], tried: Mapping[str, Sequence]
) -> tuple[dict[str, Path], dict[str, float], float, dict[str, list]]:
    """Folder of each model, seconds it took with its data, those of the data alone, and what to try."""
    data, ladders = seconds_of(map(Path, data_benchmarks)), made_from(tried, _ladders, "tried")
    read = [made_from(model, _model, "models") for model in models]
    folders = {name: folder for name, folder, _ in read}
    return folders, {name: data + seconds for name, _, seconds in read}, data, ladders


def _model(name: str, folder: str, benchmarks: Sequence[str]) -> tuple[str, Path, float]:
    return name, Path(folder), seconds_of(map(Path, benchmarks))


def _ladders(
    simulation_tolerances: Sequence[float],  # relative, and absolute in a
    forecast_tolerances: Sequence[float],  # relative, and absolute in L/2
    pod_modes: Sequence[int],
    batches: Sequence[int],
    batch_tolerances: Sequence[float],  # as those of the forecasts
) -> dict[str, list]:
    found: dict[str, list] = {
        "simulation_tolerances": tolerance_ladder("simulation_tolerances", simulation_tolerances),
        "forecast_tolerances": tolerance_ladder("forecast_tolerances", forecast_tolerances),
        "batch_tolerances": tolerance_ladder("batch_tolerances", batch_tolerances),
    }
    for key, values in {"pod_modes": pod_modes, "batches": batches}.items():
        found[key] = [whole_number(key, value, "whole numbers from 1 up", 1) for value in values]
    return found
