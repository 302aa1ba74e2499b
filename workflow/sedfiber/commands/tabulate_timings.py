"""``sedfiber tabulate_timings``: time of every stage, summed from the benchmark files."""

import argparse
from pathlib import Path

import pandas as pd

from sedfiber.atomic_file import require_writable
from sedfiber.errors import InputError
from sedfiber.tables import write_csv


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Benchmark files of all jobs."""
    parser.add_argument("benchmarks", nargs="+", type=Path, help="Snakemake benchmark files, RULE.tsv or RULE/*.tsv")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")


def run(args: argparse.Namespace) -> None:
    """One row per rule and a last one for all."""
    require_writable(args.output)
    jobs = pd.DataFrame([_job(path) for path in args.benchmarks])
    stages = [_stage(rule, group) for rule, group in jobs.groupby("rule", sort=False)]
    write_csv(pd.DataFrame([*stages, _stage("all", jobs)]), args.output)


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
    """``seconds_elapsed`` runs from the first job's start to the last one's end.

    It is the wall time that a user waits for when all jobs ran in one go, the workflow's own
    overhead included; after a partial rerun it spans both runs.
    """
    start = (jobs["end"] - jobs["seconds"]).min()
    return {
        "stage": rule,
        "jobs": len(jobs),
        "seconds_total": round(jobs["seconds"].sum(), 2),
        "seconds_median": round(jobs["seconds"].median(), 2),
        "seconds_max": round(jobs["seconds"].max(), 2),
        "seconds_elapsed": round(jobs["end"].max() - start, 2),
        "memory_MB_max": jobs["memory_MB"].max(),
    }
