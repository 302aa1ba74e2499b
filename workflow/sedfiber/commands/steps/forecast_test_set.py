"""``sedfiber forecast_test_set``: forecast every trajectory of a split from its first sample."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import torch

from sedfiber.commands.steps._step import Output, Split
from sedfiber.reduced.dataset import Dataset, SettlingFall, read_dataset
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.model_files import load_forecast_model
from sedfiber.reduced.torch_forecast import ForecastModel


def run(truth: Split, *, model: Path, output: Output) -> None:
    """Forecast at the samples of the true trajectories; same layout as the data set."""
    torch.set_num_threads(1)
    write_dataset(forecast_all(load_forecast_model(model), read_dataset(*truth)), output)


def forecast_all(model: ForecastModel, truth: Dataset) -> list[SettlingFall]:
    """Every trajectory of ``truth`` with its positions replaced by the forecast."""
    longest = max((trajectory.t for trajectory in truth), key=len)
    positions = model.forecast_many([Start.of(trajectory) for trajectory in truth], longest)
    return [_cut(trajectory, longest, rows) for trajectory, rows in zip(truth, positions, strict=True)]


def _cut(trajectory: SettlingFall, t: np.ndarray, positions: np.ndarray) -> SettlingFall:
    n = len(trajectory.t)
    if not np.array_equal(trajectory.t, t[:n]):
        raise ValueError("trajectories of one split must share their sample times")
    return replace(trajectory, positions=positions[:n])
