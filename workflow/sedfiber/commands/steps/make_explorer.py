"""``sedfiber make_explorer``: the trained model as one HTML page that forecasts in the browser, offline."""

from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.core.atomic_file import write_text


def run(*, model: Path, dataset: list[Path], output: Output) -> None:
    """Put the page together from a model folder, its terminal curve in it, and the falls of data sets."""
    from sedfiber.figures.explorer.page import explorer_page  # its imports take a second: bad input fails before it

    write_text(output, explorer_page(model, dataset))
