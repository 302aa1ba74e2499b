"""The results that the repository shows: copied from a full run of the committed code, or refused.

Published are the manifest, the explorer, every table and the SVG of every figure that the manifest has
a checksum of, so that what is shown is what one run made.
"""

import json
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path

from sedfiber.core.checksum import sha256
from sedfiber.core.errors import InputError

# What a result depends on; documents and tests may change after the run, and the shipped model is itself a result.
CODE = ("Snakefile", "config.yaml", "workflow", "envs", "profiles", ":(exclude)workflow/sedfiber/reduced/shipped")
MANIFEST = "manifest.json"
_SHOWN = ("results/explorer.html", "results/tables/*.csv", "results/figures/*.svg")


def publish(results: Path, into: Path, repository: Path) -> list[Path]:
    """Copy what is shown to ``into``, replacing what was there; returns the new files.

    Raises InputError, and writes nothing, when the run is not from the committed code or a file is
    not the one that the manifest has the checksum of.
    """
    manifest = read_manifest(results)
    require_committed(manifest["commit"], repository)
    chosen = [path for path in manifest["sha256"] if any(Path(path).match(shown) for shown in _SHOWN)]
    require_recorded(manifest, chosen, results)
    return _replace(into, [results.parent / path for path in chosen] + [results / MANIFEST], results)


def read_manifest(results: Path) -> dict:
    """The manifest of a full run; raises InputError where there is none."""
    try:
        return json.loads((results / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"publish: no manifest of a full run ({reason}); run snakemake -j2 first") from None


def require_recorded(manifest: dict, paths: Iterable[str], results: Path) -> None:
    """Every file, named as in the manifest, is the one that the manifest has the checksum of."""
    for path in paths:
        if sha256(results.parent / path) != manifest["sha256"].get(path):
            raise InputError(f"publish: {path} is not the file of the manifest; run snakemake again")


def require_committed(commit: str, repository: Path) -> None:
    """The run's commit has the code that HEAD has, and no file of the code differs from it now."""
    if commit == "unknown" or commit.endswith("-dirty"):
        raise InputError(f"publish: the run is of {commit}, not of committed code; commit, and run snakemake -j2 again")
    changed = _git(repository, "diff", "--name-only", commit, "--", *CODE)
    changed += _git(repository, "ls-files", "--others", "--exclude-standard", "--", *CODE)
    if changed:
        what = f"{changed[0]} differs from the code of the run ({commit[:9]})"
        raise InputError(f"publish: {what}; commit, and run snakemake -j2 again")


def _git(repository: Path, *words: str) -> list[str]:
    run = subprocess.run(["git", "-C", str(repository), *words], capture_output=True, text=True)
    if run.returncode != 0:
        raise InputError(f"publish: git {words[0]} failed: {run.stderr.strip().splitlines()[0]}")
    return run.stdout.splitlines()


def _replace(into: Path, files: list[Path], results: Path) -> list[Path]:
    """All in a folder beside, then renamed: a kill leaves the old folder or the new one."""
    fresh, old = into.with_name(into.name + ".new"), into.with_name(into.name + ".old")
    for folder in (fresh, old):
        shutil.rmtree(folder, ignore_errors=True)
    for file in files:
        target = fresh / file.relative_to(results)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, target)
    if into.exists():
        into.rename(old)
    fresh.rename(into)
    shutil.rmtree(old, ignore_errors=True)
    return sorted(path for path in into.rglob("*") if path.is_file())
