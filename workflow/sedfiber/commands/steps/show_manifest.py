"""``sedfiber show_manifest``: where the results come from, as an HTML page, for the report."""

import json
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.atomic_file import write_text
from sedfiber.core.errors import InputError
from sedfiber.figures.html_page import table_page


def run(manifest: Path, *, output: Output) -> None:
    """Commit, machine, versions, and the checksum of every result, one row each."""
    rows = pd.DataFrame(_rows(_read(manifest)), columns=["of", "what", "value"])
    note = f"The whole configuration and the rule graph are in {manifest}."
    write_text(output, table_page(rows, "provenance", note, len(rows)))


def _read(path: Path) -> dict:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"input: cannot read the manifest {str(path)!r} ({str(error).splitlines()[0]})") from None


def _rows(manifest: dict) -> list[tuple[str, str, str]]:
    facts = [("code", "commit", manifest["commit"]), ("code", "python", manifest["python"])]
    facts += [("lock file", key, value) for key, value in manifest["lock_file"].items()]
    facts += [("machine", key, value) for key, value in manifest["machine"].items()]
    facts += [("package", key, value) for key, value in manifest["packages"].items()]
    return facts + [("sha256", key, value) for key, value in manifest["sha256"].items()]
