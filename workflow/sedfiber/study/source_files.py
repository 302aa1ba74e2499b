"""Which files of the package a command's result depends on, read off its import statements."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parents[1]


def command_sources(command: str) -> list[Path]:
    """Every package file that ``sedfiber.commands.<command>`` imports, directly or not.

    Imports inside functions count too.  Packages' ``__init__.py`` are included where they
    contain code; the top one only maps public names and is left out, as is the dispatcher.
    """
    folder = PACKAGE / "commands"
    step = folder / "steps" / f"{command}.py"
    return _closure(step if step.is_file() else folder / f"{command}.py")


def module_sources(module: str) -> list[Path]:
    """The same for a module that a command imports by name, such as ``hard_cases.start_cases``."""
    return _closure(PACKAGE.joinpath(*module.split(".")).with_suffix(".py"))


def _closure(first: Path) -> list[Path]:
    todo, seen = [first], set()
    while todo:
        path = todo.pop()
        if path not in seen:
            seen.add(path)
            todo.extend(_imported(path))
    return sorted(seen)


@cache
def _imported(path: Path) -> tuple[Path, ...]:
    return tuple(_import_targets(path))


def _import_targets(path: Path) -> Iterator[Path]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "sedfiber":
            yield from _module_files(node.module)
            for alias in node.names:  # `from sedfiber.physics import pair_mobility`
                yield from _module_files(f"{node.module}.{alias.name}")
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.split(".")[0] == "sedfiber":
                    yield from _module_files(alias.name)


def _module_files(module: str) -> Iterator[Path]:
    base = PACKAGE.joinpath(*module.split(".")[1:])
    if base.with_suffix(".py").is_file() and base != PACKAGE:
        yield base.with_suffix(".py")
    if base != PACKAGE and (base / "__init__.py").is_file() and (base / "__init__.py").stat().st_size:
        yield base / "__init__.py"
