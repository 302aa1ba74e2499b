"""A finished tiny study, made once, and copies of it to change and rerun; and the page of a tiny explorer."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from explorer_page import make
from workflow_helpers import REPOSITORY, snakemake

from sedfiber.reduced.dataset_file import write_dataset

TINY = Path(__file__).with_name("tiny.yaml")


class Checkout:
    """A copy of the workflow in a folder of its own, with what it has made so far."""

    def __init__(self, folder: Path):
        self.folder = folder

    def snakemake(self, *words: str) -> subprocess.CompletedProcess:
        """Run Snakemake there, as a user would."""
        return snakemake(self.folder, words)

    def planned(self, *words: str) -> dict[str, int]:
        """Number of jobs of each rule that a run would start; target rules are left out."""
        run = self.snakemake(*words, "--dry-run", "--quiet", "rules")
        text = run.stdout + run.stderr
        assert run.returncode == 0, text
        jobs = {name: int(count) for name, count in re.findall(r"^(\w+) +(\d+)$", text, re.MULTILINE)}
        targets = {"all", "total", "simulations", "dataset", "autoencoders", "node", "forecasts", "errors", "figures"}
        targets |= {"scenes", "effects", "third_dimension", "states", "hard_cases", "cost", "films", "explorer"}
        return {name: count for name, count in jobs.items() if name not in targets}

    def edit(self, path: str, old: str, new: str) -> None:
        """Replace text that must be there once or more."""
        file = self.folder / path
        text = file.read_text(encoding="utf-8")
        assert old in text, f"{old!r} is not in {path}"
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def append(self, path: str, line: str) -> None:
        """Add one line to a file."""
        with (self.folder / path).open("a", encoding="utf-8") as handle:
            handle.write(line + "\n")


def check_out(folder: Path, config: Path) -> Checkout:
    """Copy the workflow's own files, with ``config`` as its config.yaml."""
    folder.mkdir(parents=True)
    shutil.copy(REPOSITORY / "Snakefile", folder)
    shutil.copy(config, folder / "config.yaml")
    for name in ("workflow", "envs", "profiles", "scenes"):
        shutil.copytree(REPOSITORY / name, folder / name)  # with the compiled kernels in __pycache__
    return Checkout(folder)


@pytest.fixture(scope="session")
def finished(tmp_path_factory) -> Checkout:
    """A tiny study that has run to its end."""
    checkout = check_out(tmp_path_factory.mktemp("finished") / "study", TINY)
    run = checkout.snakemake("-j2")
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-4000:]
    return checkout


@pytest.fixture
def rerun(finished, tmp_path) -> Checkout:
    """A copy of the finished study, times of files included, to change."""
    shutil.copytree(finished.folder, tmp_path / "study")
    return Checkout(tmp_path / "study")


@pytest.fixture
def empty(tmp_path) -> Checkout:
    """The tiny study before anything has run."""
    return check_out(tmp_path / "study", TINY)


@pytest.fixture
def full(tmp_path) -> Checkout:
    """The real study before anything has run."""
    return check_out(tmp_path / "study", REPOSITORY / "config.yaml")


@pytest.fixture(scope="session")
def check_out_tiny():
    """A function that copies the tiny study to a folder."""
    return lambda folder: check_out(folder, TINY)


@pytest.fixture(scope="session")
def falls():
    """Two falls of the training set, one of test set B."""
    from sedfiber.study.hard_cases.training_cases import simulated  # torch: most tests of this folder do without

    return [*simulated(7, (200.0,), (0, 10)), *(fall.with_facts(split="B") for fall in simulated(7, (300.0,), (7,)))]


@pytest.fixture(scope="session")
def dataset(falls, tmp_path_factory) -> Path:
    """Their file."""
    path = tmp_path_factory.mktemp("dataset") / "falls.parquet"
    write_dataset(falls, path)
    return path


@pytest.fixture(scope="session")
def explorer(trained_model, dataset, tmp_path_factory) -> Path:
    """The page's file."""
    path = tmp_path_factory.mktemp("explorer") / "explorer.html"
    make(trained_model, dataset, output=path)
    return path
