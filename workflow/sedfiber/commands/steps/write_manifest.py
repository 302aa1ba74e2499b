"""``sedfiber write_manifest``: provenance: configuration, versions and a checksum of every output."""

import json
import platform
import re
import sys
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.core.atomic_file import write_text
from sedfiber.core.checksum import sha256


def run(*, lock: Path, rule_graph: Path, outputs: list[Path], output: Output, commit: str, config: Mapping) -> None:
    """Checksum the outputs and write one JSON file.

    ``rule_graph`` is what ``snakemake --rulegraph dot`` printed, - for standard input; ``commit`` is the code's, as
    git describes it.
    """
    manifest = {
        "commit": commit,
        "config": config,
        "lock_file": {"name": lock.name, "sha256": sha256(lock)},
        "machine": {"platform": platform.platform(), "processor": _processor()},
        "packages": _versions(lock),
        "python": platform.python_version(),
        "rule_graph": _edges(sys.stdin.read() if str(rule_graph) == "-" else rule_graph.read_text(encoding="utf-8")),
        "sha256": {str(path): sha256(path) for path in sorted(outputs)},
    }
    write_text(output, json.dumps(manifest, indent=2, sort_keys=True, ensure_ascii=False) + "\n")


def _edges(dot: str) -> list[str]:
    """``rule -> rule that uses it``, sorted: Snakemake numbers the nodes anew each time."""
    names = dict(re.findall(r'^\s*(\d+)\[label = "(\w+)"', dot, re.MULTILINE))
    pairs = re.findall(r"^\s*(\d+) -> (\d+)", dot, re.MULTILINE)
    return sorted(f"{names[made]} -> {names[used]}" for made, used in pairs)


def _versions(lock: Path) -> dict[str, str]:
    """Installed version of every package that the lock file names, and of torch."""
    names = re.findall(r"^([A-Za-z0-9_.-]+)==", lock.read_text(encoding="utf-8"), re.MULTILINE)
    found = {}
    for name in [*names, "torch", "sedfiber"]:
        try:
            found[name] = version(name)
        except PackageNotFoundError:  # a tool for development that this environment lacks
            continue
    return found


def _processor() -> str:
    """The processor's name where the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "")
