"""``sedfiber film_forecast``: a film of one test trajectory, true and forecast."""

import argparse
from pathlib import Path

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.validation import positive_number
from sedfiber.figures.falls import falls_where
from sedfiber.figures.films.film import write_film
from sedfiber.figures.films.forecast import film_forecast
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.angles import angle_index as index_of


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set, the forecasts of it, which trajectory, and the film."""
    parser.add_argument("--truth", type=Path, required=True, help="Parquet file of a test split")
    parser.add_argument("--forecast", type=Path, required=True, help="forecasts of that split")
    add_settings_and_output(parser, "animated WebP file to write")


def run(args: argparse.Namespace) -> None:
    """Film the one trajectory."""
    require_writable(args.output)
    asked = made_from(args.settings, _asked)
    truth, forecast = (_one(path, *asked) for path in (args.truth, args.forecast))
    write_film(lambda: film_forecast(truth, forecast), args.output)


def _asked(B: str, angle_index: str) -> tuple[float, int]:
    return positive_number("B", B), index_of(angle_index)


def _one(path: Path, B: float, angle_index: int) -> Trajectory:
    [fall] = falls_where(falls_where(read_falls(path), "B", B), "angle_index", angle_index)
    return fall
