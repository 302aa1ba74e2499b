"""``sedfiber tabulate_audit``: what each run left out, and whether it mattered."""

from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.core.errors import InputError
from sedfiber.simulation.trajectory_file import read_trajectory


def run(trajectories: list[Path], *, output: Output) -> None:
    """One row for each run and effect that it left out."""
    rows = [row for path in trajectories for row in _rows(path)]
    write_csv(pd.DataFrame(rows, columns=["run", "B", "theta0", "effect", "matters", "number", "words"]), output)


def _rows(path: Path) -> list[dict]:
    facts = read_trajectory(path).metadata
    if "audit" not in facts:
        raise InputError(f"input: {str(path)!r} holds no audit; it is not a simulation of this version")
    what = {"run": path.stem, "B": facts["B"], "theta0": facts["scene"]["theta0"]}
    return [what | verdict for verdict in facts["audit"]]
