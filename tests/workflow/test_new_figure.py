"""A new figure takes one module and one entry in the list."""

import pytest

pytestmark = pytest.mark.slow

MODULE = '''"""Points of a table."""

import pandas as pd
from matplotlib.figure import Figure


def draw(table: pd.DataFrame, color: str) -> Figure:
    """x against y."""
    figure = Figure()
    figure.subplots().plot(table["x"], table["y"], color=color)
    return figure
'''
ENTRY = """
toy:
  shows: "x against y"
  category: 6. Beyond the study
  part: effects
  inputs: { table: results/tables/toy.csv }
  options: { color: red }
  caption: x against y, from a table of two rows.
"""
RESULT = "results/figures/toy.svg"


def test_a_new_figure_takes_one_module_and_one_entry(empty):
    """Its rule draws it, its target rule asks for it, and only its own module draws it again."""
    figures = "workflow/sedfiber/figures"
    (empty.folder / f"{figures}/toy.py").write_text(MODULE, encoding="utf-8")
    empty.append("workflow/report/figures.yaml", ENTRY)
    (empty.folder / "results/tables").mkdir(parents=True)
    (empty.folder / "results/tables/toy.csv").write_text("x,y\n0,1\n2,3\n", encoding="utf-8")
    assert empty.planned(RESULT) == {"draw_toy": 1}
    assert empty.planned("effects")["draw_toy"] == 1
    run = empty.snakemake("-j1", RESULT)
    assert run.returncode == 0, run.stdout + run.stderr
    assert (empty.folder / RESULT).stat().st_size > 1000
    assert empty.planned(RESULT) == {}
    empty.edit("workflow/report/figures.yaml", "a table of two rows", "a table that has two rows")
    empty.append(f"{figures}/baselines.py", "EDITED = 1")
    assert empty.planned(RESULT) == {}
    empty.edit("workflow/report/figures.yaml", "color: red", "color: blue")
    assert empty.planned(RESULT) == {"draw_toy": 1}
    empty.edit("workflow/report/figures.yaml", "color: blue", "color: red")
    empty.append(f"{figures}/toy.py", "EDITED = 1")
    assert empty.planned(RESULT) == {"draw_toy": 1}
