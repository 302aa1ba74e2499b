"""What several workflow tests look at."""

import hashlib
from pathlib import Path

REPOSITORY = Path(__file__).parents[2]

# times of jobs, the checksum of their table, and the pages of both
NOT_REPEATABLE = {"timings.csv", "manifest.json", "timings.html", "manifest.html"}


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
