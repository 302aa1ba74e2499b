"""`pip install .` in a fresh environment outside the checkout: the command forecasts with the shipped model."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from cold_start import START, measure, words
from workflow_helpers import REPOSITORY

import sedfiber

pytestmark = pytest.mark.slow
SLOW = ("numba", "torch", "pandas", "scipy", "matplotlib")
ENVIRONMENT = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONHOME")}


def run(*line, folder):
    done = subprocess.run([str(word) for word in line], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Folder of programs of an environment that has sedfiber from a copy, and all else from this environment."""
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
    Path(packages.stdout.strip(), "others.pth").write_text(sysconfig.get_path("purelib") + "\n")
    pip = (sys.executable, "-m", "pip", "--python", programs / "python", "install")
    how = ("--quiet", "--no-deps", "--no-build-isolation", "--no-index", "--ignore-installed")
    run(*pip, *how, copied, folder=folder)
    shutil.rmtree(copied)
    return programs


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


def test_it_imports_nothing_slow(installed, tmp_path):
    """Nor is any part of these imported by others on the way."""
    line = (installed / "python", "-X", "importtime", "-m", "sedfiber", "forecast", *START, "-o", "f.parquet")
    imported = set(re.findall(r"\| +([\w.]+)$", run(*line, folder=tmp_path).stderr, re.MULTILINE))
    assert {"numpy", "sedfiber.plain.model"} <= imported
    assert not {name.split(".")[0] for name in imported} & set(SLOW)


def test_a_cold_start_is_measured(installed, tmp_path):
    """Said, not asserted: other jobs on the machine would fail it. Shown by `pytest -s`."""
    found = measure(installed / "python", tmp_path, 3, ENVIRONMENT)
    print(words(found))
    assert found["ratio"] > 0.0
