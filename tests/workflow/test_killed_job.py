"""A job that is killed leaves nothing that a later run takes for a result."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import sedfiber

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("verb", "result"),
    [
        ("simulate", "results/dataset/A.parquet"),
        ("train_autoencoder", "results/models/autoencoders/none_d1_s0/card.json"),
    ],
)
def test_a_killed_job_leaves_nothing_that_a_rerun_takes_for_a_result(empty, verb, result):
    """SIGKILL to the job in the middle of its work; the next run repairs everything."""
    run = subprocess.Popen(
        [sys.executable, "-m", "snakemake", "-j1", result],
        cwd=empty.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    victim = _wait_for_job(empty.folder, verb)
    os.kill(victim, signal.SIGKILL)
    assert run.wait(timeout=120) != 0
    done = list((empty.folder / "results/trajectories").glob("*.parquet"))
    for path in done:
        sedfiber.read_trajectory(path)  # whole, or not there
    again = empty.snakemake("-j2", result)
    assert again.returncode == 0, again.stdout + again.stderr
    assert (empty.folder / result).exists() and not list(empty.folder.rglob("*.partial"))


def _wait_for_job(folder: Path, verb: str) -> int:
    """The process that runs ``sedfiber verb`` with its files in ``folder``."""
    deadline = time.monotonic() + 120
    while time.monotonic() < deadline:
        for process in Path("/proc").glob("[0-9]*"):
            try:
                words = (process / "cmdline").read_bytes().split(b"\0")
                if words[1:4] == [b"-m", b"sedfiber", verb.encode()] and (process / "cwd").resolve() == folder:
                    return int(process.name)
            except OSError:
                continue
        time.sleep(0.02)
    raise AssertionError(f"no job {verb} appeared")
