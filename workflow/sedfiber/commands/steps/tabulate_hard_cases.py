"""``sedfiber tabulate_hard_cases``: all hard cases in one table, the failing ones among them."""

from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv


def run(cases: list[Path], *, output: Output) -> None:
    """Put the tables of single cases below each other and print what is wrong, if anything is."""
    table = pd.concat([pd.read_csv(path) for path in cases], ignore_index=True)
    wrong = table[table["verdict"] == "wrong"]
    print(f"{table['case'].nunique()} cases, {len(table)} measurements, {len(wrong)} wrong")
    for _, row in wrong.iterrows():
        print(f"wrong: {row['case']}: {row['measured']}: {row['value']:.3g}, bound {row['bound']:.3g}")
    write_csv(table, output)
