"""The tiny study on a real Slurm of one node, interrupted, killed, and taken up again.

Not collected with the other tests: it takes root and Debian's slurm-wlm, and minutes.
`pytest tests/workflow/slurm_run.py` runs it.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from one_node_slurm import cancel_all, one_node_slurm, reason_against
from workflow_helpers import clean_environment, results_of

pytestmark = pytest.mark.slow
CORES = 2
# as a user would, but for a small node and a short patience
WORDS = [
    "--profile", "profiles/slurm", "--cores", str(CORES),
    "--slurm-init-seconds-before-status-checks", "2", "--latency-wait", "10",
]  # fmt: skip


@pytest.fixture
def slurm(tmp_path):
    """A Slurm of one node that lasts as long as the test; no way to have one is a failure, never a skip."""
    against = reason_against()
    assert against is None, against
    with one_node_slurm(tmp_path / "slurm", cores=CORES):
        yield


def jobs_of_slurm(states: str = "all") -> dict[str, tuple[str, int]]:
    """State and cores of each job that the controller knows, by job number."""
    line = ["squeue", "--noheader", f"--states={states}", "--format=%i %T %C"]
    found = subprocess.run(line, capture_output=True, text=True, check=True).stdout
    return {number: (state, int(cores)) for number, state, cores in map(str.split, found.splitlines())}


def start(checkout, log: Path) -> subprocess.Popen:
    """Snakemake in a process group of its own, so that a signal reaches it and not this test."""
    with log.open("wb") as output:
        return subprocess.Popen(
            [sys.executable, "-m", "snakemake", *WORDS],
            cwd=checkout.folder,
            env=clean_environment(),
            start_new_session=True,
            # a shell's background jobs ignore SIGINT, and so would what they start
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )


def wait_until(happened: Callable[[], bool], run: subprocess.Popen, log: Path, patience: float = 600.0) -> None:
    """Until something has happened while ``run`` goes on; else its words."""
    end = time.monotonic() + patience
    while not happened():
        assert run.poll() is None and time.monotonic() < end, log.read_text(errors="replace")[-4000:]
        time.sleep(0.2)


def times_of(folder: Path) -> dict[str, int]:
    """When each trajectory was written, in ns."""
    return {path.name: path.stat().st_mtime_ns for path in (folder / "results/trajectories").glob("*.parquet")}


def test_a_run_on_slurm_survives_an_interrupt_and_a_kill(slurm, finished, check_out_tiny, tmp_path):
    """Ctrl-C cancels what runs; SIGKILL leaves jobs to cancel by hand; in the end all is as in a local run."""
    checkout, log = check_out_tiny(tmp_path / "study"), tmp_path / "log"
    _interrupt_the_simulations(checkout, log)
    _kill_among_the_autoencoders(checkout, log)
    simulated = times_of(checkout.folder)
    assert checkout.snakemake("--unlock").returncode == 0
    run = checkout.snakemake(*WORDS)
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-4000:]
    assert times_of(checkout.folder) == simulated, "what had finished has run again"
    assert results_of(checkout.folder) == results_of(finished.folder)
    _look_at_the_jobs(checkout)


def _interrupt_the_simulations(checkout, log: Path) -> None:
    """SIGINT, as Ctrl-C sends it, once the first job is on the node."""
    run = start(checkout, log)
    wait_until(lambda: "RUNNING" in {state for state, _ in jobs_of_slurm().values()}, run, log)
    os.kill(run.pid, signal.SIGINT)
    assert run.wait(timeout=120) != 0
    left = {state for state, _ in jobs_of_slurm("PENDING,RUNNING").values()}
    assert not left, log.read_text(errors="replace")[-4000:]


def _kill_among_the_autoencoders(checkout, log: Path) -> None:
    """SIGKILL to Snakemake once some autoencoders are trained; its jobs go on until they are cancelled."""
    run = start(checkout, log)
    trained = checkout.folder / "results/models/autoencoders"
    wait_until(lambda: len(list(trained.glob("*/card.json"))) >= 2, run, log)
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    assert len(list(trained.glob("*/card.json"))) < 8, "killed too late to be in the middle"
    assert jobs_of_slurm("RUNNING"), "no job outlived Snakemake"
    cancel_all()
    assert not jobs_of_slurm("PENDING,RUNNING,COMPLETING")


def _look_at_the_jobs(checkout) -> None:
    """Fewer of Slurm's than of Snakemake's, none asked for more cores than there are."""
    jobs = jobs_of_slurm()
    members = sum(checkout.planned("--forceall").values())
    print(f"{len(jobs)} jobs of Slurm, interrupted ones included, for {members} jobs of the study")
    assert len(jobs) < members
    assert max(cores for _, cores in jobs.values()) == CORES
