"""``sedfiber draw``: one figure, from files alone.

from sedfiber.commands.steps._step import Output, Word
Each module of ``sedfiber.figures`` with a function ``draw`` is a figure. The command imports it by name when it runs,
so that an edited figure redraws no other.
"""

import inspect
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from sedfiber.commands.steps._step import Output, Word
from sedfiber.core.csv_file import read_csv
from sedfiber.core.errors import InputError
from sedfiber.figures.style import save_figure


def run(figure: Word, *, svg: Output, png: Output, inputs: Mapping, options: Mapping) -> None:
    """Read the inputs, draw with the options, each by name, and write both files."""
    draw = _drawing(figure)
    given = _given(draw, inputs, options)
    save_figure(lambda: draw(**given), svg, png)


def _drawing(figure: str) -> Callable[..., Figure]:
    """The function that draws the figure."""
    name = f"sedfiber.figures.{figure}"
    draw = getattr(import_module(name), "draw", None) if find_spec(name) else None
    if draw is None:
        raise InputError(f"figure: sedfiber.figures has no module {figure!r} with a function draw")
    return draw


def _given(draw: Callable[..., Figure], inputs: Mapping, options: Mapping) -> dict[str, Any]:
    """The inputs by name, as paths where the function takes a path, then the options as they are."""
    signature = inspect.signature(draw)
    try:
        signature.bind(**inputs, **options)
    except TypeError as error:
        raise InputError(f"settings: {error}") from None
    paths = [name for name, one in signature.parameters.items() if one.annotation is Path]
    return {name: Path(files) if name in paths else _input(files) for name, files in inputs.items()} | dict(options)


def _input(files: str | list[str]) -> Any:
    """A table (.csv) read, any other file as its path, several of them as a list."""
    if isinstance(files, list):
        return [_input(one) for one in files]
    path = Path(files)
    return read_csv(path) if path.suffix == ".csv" else path
