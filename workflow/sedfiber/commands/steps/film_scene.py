"""``sedfiber film_scene``: a film of a scene's run."""

from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.figures.films.film import write_film
from sedfiber.figures.films.scene import film_scene
from sedfiber.simulation.trajectory_file import read_trajectory


def run(trajectory: Path, *, output: Output, title: str = "") -> None:
    """Film the run of a trajectory file, ``title`` above the picture."""
    run = read_trajectory(trajectory)
    write_film(lambda: film_scene(run, title), output)
