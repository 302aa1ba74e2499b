"""``sedfiber film_forecast``: a film of one test trajectory, true and forecast."""

from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.core.validation import positive_number
from sedfiber.figures.falls import falls_where
from sedfiber.figures.films.film import write_film
from sedfiber.figures.films.forecast import film_forecast
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.angles import angle_index as index_of


def run(*, truth: Path, forecast: Path, output: Output, B: str, angle_index: str) -> None:
    """Film the one trajectory of a test split, with the forecast of it."""
    asked = positive_number("B", B), index_of(angle_index)
    pair = [_one(path, *asked) for path in (truth, forecast)]
    write_film(lambda: film_forecast(*pair), output)


def _one(path: Path, B: float, angle_index: int) -> Trajectory:
    [fall] = falls_where(falls_where(read_falls(path), "B", B), "angle_index", angle_index)
    return fall
