"""What several workflow tests look at."""

import hashlib
import multiprocessing
import os
import tempfile
from pathlib import Path

REPOSITORY = Path(__file__).parents[2]

# times of jobs, the checksum of their table, and the pages of both
NOT_REPEATABLE = {"timings.csv", "manifest.json", "timings.html", "manifest.html"}


def clean_environment() -> dict[str, str]:
    """The environment without what pytest or a calling Snakemake put there."""
    return {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "SNAKEMAKE_PROFILE")}


# Planning takes a second, importing Snakemake two more: this server imports it once and forks for each plan.
_SERVER = multiprocessing.get_context("forkserver")
_SERVER.set_forkserver_preload(["snakemake.cli"])


def dry_run(folder: Path, words: list[str]) -> str:
    """What Snakemake prints of a run that it only plans, in a process of its own; it must succeed."""
    with tempfile.NamedTemporaryFile(mode="r", encoding="utf-8") as printed:
        process = _SERVER.Process(target=_snakemake, args=(folder, words, printed.name))
        process.start()
        process.join()
        text = printed.read()
    assert process.exitcode == 0, text
    return text


def _snakemake(folder: Path, words: list[str], printed: str) -> None:
    from snakemake.cli import main

    output = os.open(printed, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(output, stream)
    os.chdir(folder)
    os.environ.pop("SNAKEMAKE_PROFILE", None)
    main(words)


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
