"""``sedfiber tabulate_forecast_errors``: E(t) of all forecasts of both test sets, as tables."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._forecasters import read_forecasts
from sedfiber.commands.steps._step import Splits
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
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


def run(*, truth: Splits, forecasts: list[Path], output: list[Path], forecasters: Sequence[Sequence]) -> None:
    """Measure every forecaster on every split and write the tables."""
    if len(output) != len(OUTPUTS):
        raise InputError(f"output: {len(output)} files are not allowed; give {', '.join(OUTPUTS)}")
    for path in output:
        require_writable(path)
    tables: dict[str, list[pd.DataFrame]] = {name: [] for name in OUTPUTS}
    for who, true, forecast in read_forecasts(truth, forecasts, forecasters):
        _add(tables, who, true, forecast)
    for parts, path in zip(tables.values(), output, strict=True):
        table = pd.concat(parts, ignore_index=True).astype({"latent_dim": "Int64"})  # the lookup has none
        write_csv(table, path)


def _add(tables: dict[str, list[pd.DataFrame]], who: ModelLabel, truth: Dataset, forecast: Dataset) -> None:
    measured = measure(truth, forecast)
    tables[_ERRORS_OF[who.recipe]].append(trajectory_rows(who, measured))
    tables["ensemble_errors"].append(ensemble_rows(who, measured))
    tables["baselines"].append(summary_rows(who, measured))
