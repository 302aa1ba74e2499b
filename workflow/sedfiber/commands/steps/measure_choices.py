"""``sedfiber measure_choices``: simulations, forecasts, lookup and POD–Galerkin on the test trajectories."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import torch

from sedfiber.commands.steps._benchmark_files import seconds_of
from sedfiber.commands.steps._data import read_splits
from sedfiber.commands.steps._step import Output, Split, Splits, made_from
from sedfiber.commands.steps._tolerances import tolerance_ladder
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import one_of, whole_number
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


def run(
    training: Split,
    *,
    tests: Splits,
    terminal_curve: Path,
    output: Output,  # a row a choice
    at_each_B: Output,  # a row a choice and ℬ
    models: Sequence[Mapping],
    judged_by_torch: str,
    data_benchmarks: Sequence[str],
    tried: Mapping[str, Sequence],
) -> None:
    """Give every query to every choice, then write both tables."""
    torch.set_num_threads(1)
    data, ladders = seconds_of(map(Path, data_benchmarks)), made_from(tried, _ladders, "tried")
    read = [made_from(model, _model, "models") for model in models]
    folders = {name: folder for name, folder, _ in read}
    preparation = {name: data + seconds for name, _, seconds in read}
    falls, curve = read_dataset(*training), read_terminal_curve(terminal_curve)
    asked = [query for split in read_splits(tests) for query in queries(split, curve.hydrodynamics)]
    found = _measure(asked, falls, folders, one_of("judged_by_torch", judged_by_torch, folders), curve, ladders)
    facts = machine_columns()
    write_csv(choices_at_each_B(found, asked, preparation, data).assign(**facts), at_each_B)
    write_csv(choices_overall(found, preparation, data).assign(**facts), output)


def _measure(
    asked: list[Query],
    training: Dataset,
    models: dict[str, Path],
    judged_by_torch: str,
    curve: TerminalCurve,
    ladders: dict[str, list],
) -> Outcomes:
    """What is fast gets every query, POD-Galerkin one of each ℬ, the one model through torch the last of these."""
    found, n_beads = Outcomes(), training.n_beads
    at = {name: forecasters(folder, ladders["forecast_tolerances"], curve) for name, folder in models.items()}
    contestants = [*simulations(ladders["simulation_tolerances"], n_beads), *lookups(training)]
    measure_single(asked, contestants + [one for name in models for one in compiled_forecasts(name, at[name])], found)
    of_each_B = list({query.B: query for query in asked}.values())
    measure_single(of_each_B, galerkins(training, ladders["pod_modes"]), found)
    through_torch = torch_forecast(judged_by_torch, models[judged_by_torch], next(iter(at[judged_by_torch].values())))
    measure_single(of_each_B[-1:], [through_torch], found)
    for name, folder in models.items():
        measure_sweeps(asked, name, forecasters(folder, ladders["batch_tolerances"], curve), ladders["batches"], found)
    return found


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
