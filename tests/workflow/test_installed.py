"""`pip install .` in a fresh environment outside the checkout: what a user calls works, with the shipped model.

The environment has what pyproject.toml asks for without extras, and what that asks for in turn: links to the
packages of this one, so that no network is needed. No torch, no Snakemake, nothing that happens to be here.
"""

import os
import re
import shutil
import subprocess
import sys
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from cold_start import START, measure, words
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from workflow_helpers import REPOSITORY

import sedfiber
from sedfiber.commands.cli import TOOLS

pytestmark = pytest.mark.slow
SLOW = ("numba", "torch", "pandas", "scipy", "matplotlib")
ENVIRONMENT = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONHOME")}


def run(*line, folder):
    done = subprocess.run([str(word) for word in line], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Folder of programs of an environment that has sedfiber from a copy, and what it depends on."""
    folder = tmp_path_factory.mktemp("installed")
    copied = folder / "copy"
    copied.mkdir()
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(REPOSITORY / name, copied)
    nothing_compiled = shutil.ignore_patterns("__pycache__", "*.egg-info")
    shutil.copytree(REPOSITORY / "workflow", copied / "workflow", ignore=nothing_compiled)
    run(sys.executable, "-m", "venv", "--without-pip", folder / "fresh", folder=folder)
    programs = folder / "fresh/bin"
    packages = run(programs / "python", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", folder=folder)
    for package in dependencies("sedfiber"):
        link(package, Path(packages.stdout.strip()))
    how = ("--quiet", "--no-deps", "--no-index")
    run(sys.executable, "-m", "pip", "wheel", *how, "--no-build-isolation", copied, folder=folder)  # builds here
    run(*pip(programs), "install", *how, next(folder.glob("*.whl")), folder=folder)
    shutil.rmtree(copied)
    return programs


def pip(programs: Path) -> tuple:
    """The beginning of a line that calls this environment's pip on that one."""
    return (sys.executable, "-m", "pip", "--python", programs / "python")


def dependencies(root: str) -> list[Distribution]:
    """Every package that one needs without extras, itself left out; from the metadata of what is installed here."""
    found, waiting = {canonicalize_name(root): distribution(root)}, [distribution(root)]
    while waiting:
        for line in waiting.pop().requires or []:
            wanted = Requirement(line)
            name = canonicalize_name(wanted.name)
            if name not in found and (wanted.marker is None or wanted.marker.evaluate({"extra": ""})):
                found[name] = distribution(name)
                waiting.append(found[name])
    return list(found.values())[1:]


def link(package: Distribution, folder: Path) -> None:
    """Its modules, libraries and metadata, but no programs."""
    for name in {path.parts[0] for path in package.files} - {"..", "__pycache__"}:
        (folder / name).symlink_to(package.locate_file(name))


def test_its_dependencies_are_all_there_and_nothing_else(installed, tmp_path):
    """By pip's own reckoning; what trains models and runs the workflow is not."""
    assert "No broken requirements" in run(*pip(installed), "check", folder=tmp_path).stdout
    names = {line.split("==")[0] for line in run(*pip(installed), "freeze", folder=tmp_path).stdout.splitlines()}
    assert {"numpy", "numba", "matplotlib"} <= names and not {"torch", "torchdiffeq", "snakemake"} & names


def test_the_command_forecasts_with_the_model_that_came_along(installed, tmp_path):
    """From another folder; the file is that of the checkout's own model, warnings included."""
    where = run(installed / "python", "-c", "import sedfiber; print(sedfiber.__file__)", folder=tmp_path).stdout
    assert str(installed.parent) in where
    run(installed / "sedfiber", "forecast", *START, "-o", "f.parquet", folder=tmp_path)
    written = sedfiber.read_trajectory(tmp_path / "f.parquet")
    assert written.metadata["kind"] == "forecast" and written.metadata["model"]["warnings"] == []
    assert written.t[-1] == pytest.approx(written.settling_time, abs=1.0)
    here = sedfiber.load_model().forecast(1000, 0.7854, written.t)
    assert abs(here - written.positions).max() < 1e-4


def test_every_tool_works_there(installed, tmp_path):
    """A user's commands, one after the other, each with what the ones before it wrote."""
    lines = {
        "forecast": [*START, "-o", "forecast.parquet"],
        "simulate": [*START, "-o", "simulated.parquet"],
        "steady": ["--B", "1000", "--json"],
        "effects": [],
        "compare": ["simulated.parquet", "forecast.parquet", "-o", "e.csv"],
        "plot": ["simulated.parquet", "-o", "simulated.png"],
        "advise": ["--help"],
    }
    assert set(lines) == set(TOOLS)
    for name, rest in lines.items():
        run(installed / "sedfiber", name, *rest, folder=tmp_path)
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {"forecast.parquet", "simulated.parquet", "e.csv", "simulated.png"}


def test_it_imports_nothing_slow(installed, tmp_path):
    """Nor is any part of these imported by others on the way."""
    line = (installed / "python", "-X", "importtime", "-m", "sedfiber", "forecast", *START, "-o", "f.parquet")
    imported = set(re.findall(r"\| +([\w.]+)$", run(*line, folder=tmp_path).stderr, re.MULTILINE))
    assert {"numpy", "sedfiber.reduced.plain.model"} <= imported
    assert not {name.split(".")[0] for name in imported} & set(SLOW)


def test_a_cold_start_is_measured(installed, tmp_path):
    """Said, not asserted: other jobs on the machine would fail it. Shown by `pytest -s`."""
    found = measure(installed / "python", tmp_path, 3, ENVIRONMENT)
    print(words(found))
    assert found["ratio"] > 0.0
