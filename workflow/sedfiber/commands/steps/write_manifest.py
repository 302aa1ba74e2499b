"""``sedfiber write_manifest``: provenance: configuration, versions and a checksum of every output."""

import argparse
import json
import platform
import re
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable, write_text
from sedfiber.core.checksum import sha256


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Everything the manifest records."""
    parser.add_argument("--lock", type=Path, required=True, help="lock file")
    parser.add_argument(
        "--rule-graph", type=argparse.FileType(), required=True, help="what snakemake --rulegraph dot printed, or -"
    )
    parser.add_argument("--outputs", nargs="+", type=Path, required=True, help="files to checksum")
    add_settings_and_output(parser, "JSON file to write")


def run(args: argparse.Namespace) -> None:
    """Checksum the outputs and write one JSON file."""
    require_writable(args.output)
    manifest = {
        **made_from(args.settings, _facts),
        "lock_file": {"name": args.lock.name, "sha256": sha256(args.lock)},
        "machine": {"platform": platform.platform(), "processor": _processor()},
        "packages": _versions(args.lock),
        "python": platform.python_version(),
        "rule_graph": _edges(args.rule_graph.read()),
        "sha256": {str(path): sha256(path) for path in sorted(args.outputs)},
    }
    write_text(args.output, json.dumps(manifest, indent=2, sort_keys=True, ensure_ascii=False) + "\n")


def _facts(commit: str, config: Mapping) -> dict:
    """The commit of the code, as git describes it, and the whole configuration."""
    return {"commit": commit, "config": config}


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
