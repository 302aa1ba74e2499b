"""``sedfiber tabulate_timings``: time of every stage, summed from the benchmark files."""

from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError


def run(benchmarks: list[Path], *, output: Output) -> None:
    """One row per rule, then the sum, then what a user waited from the first start to the last end.

    Snakemake's benchmark files are RULE.tsv or RULE/*.tsv.
    """
    jobs = pd.DataFrame([_job(path) for path in benchmarks])
    stages = [_stage(rule, group) for rule, group in jobs.groupby("rule", sort=False)]
    write_csv(pd.DataFrame([*stages, _stage("all", jobs), _elapsed(jobs)]), output)


def _job(path: Path) -> dict:
    try:
        row = pd.read_csv(path, sep="\t").iloc[-1]
        rule = path.stem if path.parent.name == "benchmarks" else path.parent.name
        seconds, end = float(row["s"]), path.stat().st_mtime
        return {"rule": rule, "seconds": seconds, "end": end, "memory_MB": _number(row["max_rss"])}
    except (OSError, KeyError, IndexError, ValueError) as error:
        raise InputError(f"input: {str(path)!r} is not a benchmark file ({error})") from None


def _number(value: object) -> float:
    """Snakemake writes ``NA`` for a job too short to be sampled."""
    return float(pd.to_numeric(value, errors="coerce"))


def _stage(rule: str, jobs: pd.DataFrame) -> dict:
    """``minutes_at_j2`` is the sum spread over two jobs at a time, the default of ``make reproduce``."""
    return {
        "stage": rule,
        "jobs": len(jobs),
        "seconds_total": round(jobs["seconds"].sum(), 2),
        "seconds_median": round(jobs["seconds"].median(), 2),
        "seconds_max": round(jobs["seconds"].max(), 2),
        "minutes_at_j2": round(jobs["seconds"].sum() / 120.0, 2),
        "memory_MB_max": jobs["memory_MB"].max(),
    }


def _elapsed(jobs: pd.DataFrame) -> dict:
    """Wall time with the workflow's own overhead; only meaningful when all jobs ran in one go."""
    start = (jobs["end"] - jobs["seconds"]).min()
    return {"stage": "elapsed", "jobs": len(jobs), "seconds_total": round(jobs["end"].max() - start, 2)}
