"""``sedfiber forecast_by_lookup``: the baseline without a model, splines through the training runs."""

from dataclasses import replace

from sedfiber.commands.steps._step import Output, Split
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.study.lookup import LookupTable


def run(truth: Split, *, training: Split, output: Output) -> None:
    """Interpolate at the samples of the true trajectories; same layout as the data set."""
    table = LookupTable(read_dataset(*training))
    forecasts = [replace(one, positions=table.forecast(one.B, one.theta0, one.t)) for one in read_dataset(*truth)]
    write_dataset(forecasts, output)
