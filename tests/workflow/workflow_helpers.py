"""What several workflow tests look at."""

import hashlib
import os
from pathlib import Path

REPOSITORY = Path(__file__).parents[2]

# times of jobs, the checksum of their table, and the pages of both
NOT_REPEATABLE = {"timings.csv", "manifest.json", "timings.html", "manifest.html"}


def clean_environment() -> dict[str, str]:
    """The environment without what pytest or a calling Snakemake put there."""
    return {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "SNAKEMAKE_PROFILE")}


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
