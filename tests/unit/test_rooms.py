"""The rooms of the package: imports go one way and in no circle; files and functions stay short."""

import ast
import re
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from sedfiber.scene.parts import PARTS

PACKAGE = Path(__file__).parents[2] / "workflow" / "sedfiber"
ROOMS = ["core", "physics", "scene", "simulation", "reduced", "study", "figures", "commands"]


def name_of(path):
    """Dotted name of a file, that of its folder for ``__init__.py``."""
    return ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__")


FILES = {name_of(path): path for path in PACKAGE.rglob("*.py")}
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in FILES.items()}


def imports(name):
    """Modules of the package that one imports, inside functions too."""
    for node in ast.walk(TREES[name]):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in FILES)
        elif isinstance(node, ast.ImportFrom):
            below = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (each if each in FILES else node.module for each in below if node.module in FILES)


def test_the_top_of_the_package_is_its_rooms():
    entries = [path.name for path in PACKAGE.iterdir() if path.name != "__pycache__"]
    assert sorted(entries) == sorted([*ROOMS, "__init__.py", "__main__.py"])


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_from_those_before_it(room):
    allowed = ROOMS[: ROOMS.index(room) + 1]
    inside = [name for name in FILES if name.startswith(f"sedfiber.{room}")]
    wrong = [
        (name, other)
        for name in inside
        for other in imports(name)
        if other.count(".") and other.split(".")[1] not in allowed
    ]
    assert wrong == []


def test_no_circle_of_modules():
    TopologicalSorter({name: set(imports(name)) for name in FILES}).prepare()


def test_no_file_is_longer_than_250_lines():
    assert [name for name, path in FILES.items() if len(path.read_text(encoding="utf-8").splitlines()) > 250] == []


def test_a_function_longer_than_60_lines_is_a_kernel_that_says_why():
    for name, tree in TREES.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and node.end_lineno - node.lineno >= 60:
                text = ast.get_source_segment(FILES[name].read_text(encoding="utf-8"), node)
                assert "# One kernel: " in text, f"{name}.{node.name} is too long"


def test_a_part_names_files_that_exist():
    """``sedfiber effects`` shows users in which files a part acts, with braces around several of a folder."""
    for part in PARTS:
        named = re.sub(
            r"(\w+)/\{(.*?)\}\.py", lambda m: ", ".join(f"{m[1]}/{one}.py" for one in m[2].split(", ")), part.acts_in
        )
        assert all((PACKAGE / path).is_file() for path in named.split(", ")), f"{part.key}: {named}"
