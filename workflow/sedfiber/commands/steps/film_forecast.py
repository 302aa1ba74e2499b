"""``sedfiber film_forecast``: a film of one test trajectory, true and forecast."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.figures.falls import falls_where
from sedfiber.figures.films.film import write_film
from sedfiber.figures.films.forecast import film_forecast
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.simulation.trajectory import Trajectory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set, the forecasts of it, which trajectory, and the film."""
    parser.add_argument("--truth", type=Path, required=True, help="Parquet file of a test split")
    parser.add_argument("--forecast", type=Path, required=True, help="forecasts of that split")
    parser.add_argument("--B", type=float, required=True, help="elasto-gravitational number")
    parser.add_argument("--angle-index", type=int, required=True, help="k of θ₀ = kπ/48")
    parser.add_argument("-o", "--output", type=Path, required=True, help="animated WebP file to write")


def run(args: argparse.Namespace) -> None:
    """Film the one trajectory."""
    require_writable(args.output)
    truth, forecast = (_one(path, args.B, args.angle_index) for path in (args.truth, args.forecast))
    write_film(lambda: film_forecast(truth, forecast), args.output)


def _one(path: Path, B: float, angle_index: int) -> Trajectory:
    [fall] = falls_where(falls_where(read_falls(path), "B", B), "angle_index", angle_index)
    return fall
