"""A Slurm of one node on this machine's loopback, from Debian's slurm-wlm: started, and taken away again.

Slurm's commands look for their configuration in /etc/slurm alone, also within jobs, so that is where
it is written; a machine that has one already is left alone. Without a database for accounting, what
became of a job is known only as long as the controller remembers it: MinJobAge.
"""

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

CONFIGURATION = Path("/etc/slurm/slurm.conf")
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")
OURS = "# written by a test of sedfiber, and removed at its end\n"
TEMPLATE = """\
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory}
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MinJobAge=3600
ReturnToService=2
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
"""


def reason_against() -> str | None:
    """Why there can be no Slurm here, in one line; None when there can."""
    missing = [program for program in PROGRAMS if shutil.which(program) is None]
    if missing:
        return f"{missing[0]} is not installed (Debian: apt-get install slurm-wlm)"
    if os.geteuid() != 0:
        return "starting Slurm's daemons takes root"
    if CONFIGURATION.exists() and not CONFIGURATION.read_text().startswith(OURS):  # ours: of a test that was killed
        return f"{CONFIGURATION} exists: this machine belongs to a cluster"
    return None


@contextmanager
def one_node_slurm(folder: Path, cores: int = 2, memory: int = 8000) -> Iterator[None]:
    """Controller, node and their authentication run while this is open; ``memory`` in MB."""
    host = socket.gethostname().split(".")[0]
    for name in ("state", "spool"):
        (folder / name).mkdir(parents=True)
    CONFIGURATION.parent.mkdir(exist_ok=True)
    text = OURS + TEMPLATE.format(host=host, cores=cores, memory=memory, folder=folder)
    CONFIGURATION.write_text(text, encoding="utf-8")
    daemons: list[subprocess.Popen] = []
    try:
        daemons += _start(folder)
        _wait_until_idle(folder)
        yield
    finally:
        cancel_all()
        for daemon in reversed(daemons):
            daemon.terminate()
            daemon.wait()
        CONFIGURATION.unlink()


def cancel_all(patience: float = 60.0) -> None:
    """Cancel every job of this user, and wait until none is left."""
    subprocess.run(["scancel", "--me"], check=False)  # fails where the controller never came up
    end = time.monotonic() + patience
    line = ["squeue", "--me", "--noheader", "--states=PENDING,RUNNING,COMPLETING"]
    while subprocess.run(line, capture_output=True, text=True).stdout and time.monotonic() < end:
        time.sleep(0.2)


def _start(folder: Path) -> list[subprocess.Popen]:
    """munged with a key of its own, then the controller and the node, all in the foreground."""
    key = folder / "munge.key"
    key.write_bytes(os.urandom(128))
    key.chmod(0o600)
    paths = {"socket": "munge.socket", "pid-file": "munge.pid", "log-file": "munge.log", "seed-file": "munge.seed"}
    options = [f"--{option}={folder / name}" for option, name in paths.items()]
    commands = [
        ["munged", "--foreground", "--force", f"--key-file={key}", *options],
        ["slurmctld", "-D"],
        ["slurmd", "-D"],
    ]
    return [_daemon(command, folder) for command in commands]


def _daemon(command: list[str], folder: Path) -> subprocess.Popen:
    with (folder / f"{command[0]}.out").open("wb") as output:
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)


def _wait_until_idle(folder: Path, patience: float = 60.0) -> None:
    """Until the controller says that its node is idle; the logs' ends otherwise."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        state = subprocess.run(["sinfo", "--noheader", "--format=%T"], capture_output=True, text=True)
        if state.stdout.strip() == "idle":
            return
        time.sleep(0.5)
    logs = "\n".join(path.read_text(errors="replace")[-2000:] for path in sorted(folder.glob("slurm*.[lo]*")))
    raise RuntimeError(f"Slurm's node was not idle within {patience:g} s; {state.stdout}{state.stderr}\n{logs}")
