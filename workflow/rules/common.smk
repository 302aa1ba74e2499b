# What all rules share: the validated configuration, names of files, and the sources of a command.

import shlex
import sys
from pathlib import Path

sys.path.insert(0, str(Path(workflow.basedir) / "workflow"))

from sedfiber.source_files import command_sources
from sedfiber.study import Study

STUDY = Study.from_config(config, Path(workflow.basedir) / "workflow/schemas/config.schema.yaml")
LOCK = "envs/requirements.lock"


wildcard_constraints:
    B=r"[0-9.e+]+",
    k=r"\d+",
    split="train|A|B",
    variant="none|encoder|decoder|double",
    dim=r"\d+",
    seed=r"\d+",


# With --sdm conda each job's own python is meant, otherwise the one that runs this workflow.
USES_CONDA = any("conda" in str(m).lower() for m in workflow.deployment_settings.deployment_method)
PYTHON = "python" if USES_CONDA else sys.executable
SOURCE_ROOT = str(Path(workflow.basedir) / "workflow")

shell.prefix(
    "set -euo pipefail; "
    "export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1; "
    f"export PYTHONPATH={shlex.quote(SOURCE_ROOT)}; "
    # doubled twice: once for this f-string, once because Snakemake formats the prefix
    f'sedfiber() {{{{ {shlex.quote(PYTHON)} -m sedfiber "$@"; }}}}; '
)


def sources(command):
    """The lock file and every package file that a command's result depends on."""
    files = [str(path.relative_to(workflow.basedir)) for path in command_sources(command)]
    return [LOCK, *files]


def trajectory(B, k):
    return f"results/trajectories/B{B}_k{k}.parquet"


def trajectories(split):
    return [trajectory(B, k) for B, k in STUDY.runs(split)]
