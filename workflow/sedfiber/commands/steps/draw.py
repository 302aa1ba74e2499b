"""``sedfiber draw``: one figure, from files alone.

Each module of ``sedfiber.figures`` with a function ``draw`` is a figure. The command imports it by name when it runs,
so that an edited figure redraws no other.
"""

import argparse
import inspect
import json
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import read_csv
from sedfiber.core.errors import InputError
from sedfiber.figures.style import save_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The figure, what it reads and how, the two files to write."""
    parser.add_argument("figure", help="module of sedfiber.figures that draws it")
    parser.add_argument("--settings", required=True, help="JSON object of its inputs and options, each by name")
    parser.add_argument("--svg", type=Path, required=True, help="SVG file to write")
    parser.add_argument("--png", type=Path, required=True, help="PNG file to write")


def run(args: argparse.Namespace) -> None:
    """Refuse unusable outputs and settings, then read, draw and write both files."""
    for path in (args.svg, args.png):
        require_writable(path)
    draw = _drawing(args.figure)
    given = _given(draw, args.settings)
    save_figure(lambda: draw(**given), args.svg, args.png)


def _drawing(figure: str) -> Callable[..., Figure]:
    """The function that draws the figure."""
    name = f"sedfiber.figures.{figure}"
    draw = getattr(import_module(name), "draw", None) if find_spec(name) else None
    if draw is None:
        raise InputError(f"figure: sedfiber.figures has no module {figure!r} with a function draw")
    return draw


def _given(draw: Callable[..., Figure], text: str) -> dict[str, Any]:
    """The inputs by name, as paths where the function takes a path, then the options as they are."""
    try:
        settings = json.loads(text)
        inputs, options = settings["inputs"], settings["options"]
        signature = inspect.signature(draw)
        signature.bind(**inputs, **options)
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"settings: {error}") from None
    paths = [name for name, one in signature.parameters.items() if one.annotation is Path]
    return {name: Path(files) if name in paths else _input(files) for name, files in inputs.items()} | options


def _input(files: str | list[str]) -> Any:
    """A table (.csv) read, any other file as its path, several of them as a list."""
    if isinstance(files, list):
        return [_input(one) for one in files]
    path = Path(files)
    return read_csv(path) if path.suffix == ".csv" else path
