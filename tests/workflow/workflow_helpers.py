"""What several workflow tests look at."""

import hashlib
import multiprocessing
import os
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

REPOSITORY = Path(__file__).parents[2]

# times of jobs, the checksum of their table, and the pages of both
NOT_REPEATABLE = {"timings.csv", "manifest.json", "timings.html", "manifest.html"}


def clean_environment() -> dict[str, str]:
    """The environment without what pytest or a calling Snakemake put there."""
    return {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "SNAKEMAKE_PROFILE")}


# Importing Snakemake takes longer than most of what the tests have it do: this server imports it once and forks.
_SERVER = multiprocessing.get_context("forkserver")
_SERVER.set_forkserver_preload(["snakemake.cli"])


def snakemake(folder: Path, words: Sequence[str]) -> subprocess.CompletedProcess:
    """Run Snakemake in ``folder``, as a user would, in a process of its own."""
    with tempfile.TemporaryDirectory() as kept:
        said = [Path(kept, name) for name in ("stdout", "stderr")]
        process = _SERVER.Process(target=_snakemake, args=(folder, words, said))
        process.start()
        process.join()
        texts = [path.read_text(encoding="utf-8") for path in said]
    return subprocess.CompletedProcess(words, process.exitcode, *texts)


def _snakemake(folder: Path, words: Sequence[str], said: list[Path]) -> None:
    from snakemake.cli import main

    for stream, path in zip((1, 2), said, strict=True):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND), stream)
    os.chdir(folder)
    for key in os.environ.keys() - clean_environment().keys():
        del os.environ[key]
    main(list(words))


def results_of(folder: Path) -> dict[str, str]:
    """Checksum of every result; logs and benchmark files are about a run, not of it."""
    results = folder / "results"
    return {
        str(path.relative_to(results)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(results.rglob("*"))
        if path.is_file()
        and path.relative_to(results).parts[0] not in ("logs", "benchmarks")
        and path.name not in NOT_REPEATABLE
    }
