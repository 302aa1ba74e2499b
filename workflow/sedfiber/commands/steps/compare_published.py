"""``sedfiber compare_published``: a fresh run's numbers against the published ones, within stated tolerances."""

from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import read_csv, write_csv
from sedfiber.core.errors import NumericalError
from sedfiber.study.published_comparison import COMPARED, compare


def run(*, published: Path, fresh: Path, output: Output) -> None:
    """Print and write one row a comparison of two folders of tables; fail, with the first that is outside."""
    names = dict.fromkeys(one.table for one in COMPARED)
    pairs = {name: [read_csv(folder / f"{name}.csv") for folder in (published, fresh)] for name in names}
    table = pd.concat([compare(name, *pair) for name, pair in pairs.items()], ignore_index=True)
    print(table.to_string(index=False))
    outside = table[~table["within"]]
    if len(outside):
        first = outside.iloc[0]
        raise NumericalError(
            f"compare: {first['table']}.csv, {first['what']}: {first['where']} differs by a factor of "
            f"{first['largest_factor']:.3g}, allowed is {first['allowed_factor']:.6g}; the code's results have "
            "changed: make publish, if that is meant"
        )
    write_csv(table, output)
