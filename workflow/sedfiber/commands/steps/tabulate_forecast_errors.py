"""``sedfiber tabulate_forecast_errors``: E(t) of all forecasts of both test sets, as tables."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._forecasters import add_forecaster_arguments, read_forecasts
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.reduced.dataset import Dataset
from sedfiber.study.error_tables import (
    ModelLabel,
    ensemble_rows,
    measure,
    summary_rows,
    trajectory_rows,
)

OUTPUTS = ("forecast_errors", "source_errors", "lookup_errors", "ensemble_errors", "baselines")
_ERRORS_OF = {"rollout": "forecast_errors", "source": "source_errors", "lookup": "lookup_errors"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True splits, forecasts of each by each forecaster, and one file per table."""
    add_forecaster_arguments(parser)
    files = ", ".join(OUTPUTS)
    parser.add_argument("-o", "--output", nargs=len(OUTPUTS), type=Path, required=True, help=f"CSV files of {files}")


def run(args: argparse.Namespace) -> None:
    """Measure every forecaster on every split and write the tables."""
    for path in args.output:
        require_writable(path)
    tables: dict[str, list[pd.DataFrame]] = {name: [] for name in OUTPUTS}
    for who, truth, forecast in read_forecasts(args):
        _add(tables, who, truth, forecast)
    for parts, path in zip(tables.values(), args.output, strict=True):
        table = pd.concat(parts, ignore_index=True).astype({"latent_dim": "Int64"})  # the lookup has none
        write_csv(table, path)


def _add(tables: dict[str, list[pd.DataFrame]], who: ModelLabel, truth: Dataset, forecast: Dataset) -> None:
    measured = measure(truth, forecast)
    tables[_ERRORS_OF[who.recipe]].append(trajectory_rows(who, measured))
    tables["ensemble_errors"].append(ensemble_rows(who, measured))
    tables["baselines"].append(summary_rows(who, measured))
