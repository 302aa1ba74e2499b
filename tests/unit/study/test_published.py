"""Publishing copies a run of committed code, whole, and refuses anything else."""

import hashlib
import json
import subprocess
from pathlib import Path

import pytest

from sedfiber.core.errors import InputError
from sedfiber.study.published import publish


def git(folder: Path, *words: str) -> str:
    who = ["-c", "user.name=test", "-c", "user.email=test@example.org"]
    return subprocess.run(["git", *who, *words], cwd=folder, check=True, capture_output=True, text=True).stdout.strip()


@pytest.fixture
def checkout(tmp_path) -> Path:
    """A repository with code, and results of a run of its last commit."""
    git(tmp_path, "init", "-q")
    (tmp_path / ".gitignore").write_text("results/\n")
    (tmp_path / "workflow").mkdir()
    (tmp_path / "workflow/physics.py").write_text("g = 1\n")
    (tmp_path / "README.md").write_text("words\n")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-qm", "code")
    files = {"tables/a.csv": "x\n1\n", "figures/a.svg": "<svg/>", "figures/a.png": "png", "models/m.bin": "m"}
    files["explorer.html"] = "<html>"
    for name, text in files.items():
        path = tmp_path / "results" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    write_manifest(tmp_path, git(tmp_path, "rev-parse", "HEAD"), files)
    return tmp_path


def write_manifest(folder: Path, commit: str, files: dict[str, str]) -> None:
    digests = {f"results/{name}": hashlib.sha256(text.encode()).hexdigest() for name, text in files.items()}
    (folder / "results/manifest.json").write_text(json.dumps({"commit": commit, "sha256": digests}))


def published(folder: Path) -> set[str]:
    into = folder / "results/published"
    publish(folder / "results", into, folder)
    return {str(path.relative_to(into)) for path in into.rglob("*") if path.is_file()}


def test_tables_drawings_and_manifest_are_copied_and_nothing_else(checkout):
    """Pixels, models and trajectories stay where they are."""
    assert published(checkout) == {"manifest.json", "explorer.html", "tables/a.csv", "figures/a.svg"}


def test_what_was_published_before_is_replaced(checkout):
    """A table that is no more is not left behind."""
    published(checkout)
    (checkout / "results/published/tables/old.csv").write_text("x\n")
    assert published(checkout) == {"manifest.json", "explorer.html", "tables/a.csv", "figures/a.svg"}
    assert {path.name for path in (checkout / "results").iterdir()} == {
        "manifest.json", "explorer.html", "tables", "figures", "models", "published",
    }  # fmt: skip


def test_documents_may_change_after_the_run(checkout):
    """They show what is published, so they come later."""
    (checkout / "README.md").write_text("other words\n")
    git(checkout, "commit", "-qam", "words")
    assert "tables/a.csv" in published(checkout)


def edit(checkout: Path) -> None:
    (checkout / "workflow/physics.py").write_text("g = 2\n")


def edit_and_commit(checkout: Path) -> None:
    edit(checkout)
    git(checkout, "commit", "-qam", "other physics")


def add_a_file(checkout: Path) -> None:
    (checkout / "workflow/more.py").write_text("h = 1\n")


def run_uncommitted(checkout: Path) -> None:
    write_manifest(checkout, git(checkout, "rev-parse", "HEAD") + "-dirty", {})


def change_a_result(checkout: Path) -> None:
    (checkout / "results/tables/a.csv").write_text("x\n2\n")


def lose_the_manifest(checkout: Path) -> None:
    (checkout / "results/manifest.json").unlink()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (edit, "workflow/physics.py differs from the code of the run"),
        (edit_and_commit, "workflow/physics.py differs from the code of the run"),
        (add_a_file, "workflow/more.py differs from the code of the run"),
        (run_uncommitted, "-dirty, not of committed code"),
        (change_a_result, "results/tables/a.csv is not the file of the manifest"),
        (lose_the_manifest, "no manifest of a full run"),
    ],
)
def test_a_run_that_is_not_of_the_committed_code_is_refused(checkout, change, words):
    """One line that says what to do; what was published before stays."""
    published(checkout)
    before = (checkout / "results/published/manifest.json").read_bytes()
    change(checkout)
    with pytest.raises(InputError, match=words):
        published(checkout)
    assert (checkout / "results/published/manifest.json").read_bytes() == before
