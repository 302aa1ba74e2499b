"""A fingerprint of the code that a command runs; it changes when the result may.

Of every package file that a command imports the syntax tree counts, without docstrings: reworded
comments and new line breaks change nothing, a changed constant or expression does.
"""

import ast
import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parents[1]


def code_fingerprint(command: str, modules: Iterable[str] = (), files: Iterable[Path] = ()) -> str:
    """Sixteen hexadecimal digits that stand for the code of a command.

    ``modules`` are those that the command imports by name when it runs, such as
    ``study.hard_cases.start_cases``; ``files`` count with all their bytes.
    """
    sources = {path for one in (command_module(command), *modules) for path in module_sources(one)}
    digest = hashlib.sha256()
    for path in sorted(sources):
        digest.update(f"{path.relative_to(PACKAGE)}\0{_parsed(path).meaning}\0".encode())
    for path in files:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def command_module(command: str) -> str:
    """The module that does the work of a command: that of its rule, where a tool has the same name."""
    is_step = (PACKAGE / "commands/steps" / f"{command}.py").is_file()
    return f"commands.steps.{command}" if is_step else f"commands.{command}"


def module_sources(module: str) -> list[Path]:
    """Every package file that a module imports, directly or not, and its own.

    Imports inside functions count too.  Packages' ``__init__.py`` are included where they
    contain code; the top one only maps public names and is left out, as is the dispatcher.
    """
    return _closure(PACKAGE.joinpath(*module.split(".")).with_suffix(".py"))


@dataclass(frozen=True)
class _Module:
    """One file: the checksum of its syntax tree without docstrings, and the package files it imports."""

    meaning: str
    imported: tuple[Path, ...]


@cache
def _parsed(path: Path) -> _Module:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    statements = [tree, *_statements(tree)]
    imported = tuple(target for one in statements for target in _import_targets(one))
    for one in statements:
        if isinstance(body := getattr(one, "body", None), list):
            body[:] = [inner for inner in body if not _is_docstring(inner)]
    return _Module(hashlib.sha256(ast.dump(tree).encode()).hexdigest(), imported)


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """All statements below a node; expressions hold no imports and no docstrings, and are most of a tree."""
    for field in ("body", "orelse", "finalbody", "handlers", "cases"):
        for inner in getattr(node, field, ()):
            yield inner
            if not isinstance(inner, ast.Expr):
                yield from _statements(inner)


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


@cache
def _closure(first: Path) -> list[Path]:
    todo, seen = [first], set()
    while todo:
        path = todo.pop()
        if path not in seen:
            seen.add(path)
            todo.extend(_parsed(path).imported)
    return sorted(seen)


def _import_targets(node: ast.AST) -> Iterator[Path]:
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
