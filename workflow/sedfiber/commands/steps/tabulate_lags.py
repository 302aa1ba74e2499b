"""``sedfiber tabulate_lags``: by how much time each forecast is late, and what error is left without that."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._forecasters import read_forecasts
from sedfiber.commands.steps._step import Output, Splits
from sedfiber.core.csv_file import write_csv
from sedfiber.study.lag import lag_rows


def run(*, truth: Splits, forecasts: list[Path], output: Output, forecasters: Sequence[Sequence]) -> None:
    """Measure every forecaster on every split and write the table."""
    read = read_forecasts(truth, forecasts, forecasters)
    parts = [lag_rows(who, true, forecast) for who, true, forecast in read]
    table = pd.concat(parts, ignore_index=True).astype({"latent_dim": "Int64"})  # the lookup has none
    write_csv(table, output)
