"""A fresh run against the published one: equal where it must be, within a factor where trainings differ."""

import pandas as pd
import pytest

from command_line import run_step
from sedfiber.commands.steps import compare_published
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.study.published_comparison import COMPARED, compare


def trajectories(settling_time: float = 300.0, settled_to: str = "U") -> pd.DataFrame:
    return pd.DataFrame({"B": [100.0, 200.0], "angle_index": [0, 1], "settled_to": ["U", settled_to]}).assign(
        settling_time=[15.0, settling_time]
    )


def reconstruction(pod: float = 0.5, loss: float = 1e-3) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "method": ["autoencoder", "pod"],
            "variant": ["none", None],
            "seed": [0, None],
            "latent_dim": [1, 1],
            "test_set": ["A", "A"],
            "loss": [loss, pod],
        }
    )


TABLES = {
    "trajectories": trajectories(),
    "regimes": pd.DataFrame({"B": [100.0], "angle_index": [0], "regime": ["rotation"]}),
    "audit": pd.DataFrame({"run": ["B100_k0"], "effect": ["contact"], "matters": [False]}),
    "reconstruction": reconstruction(),
    "baselines": pd.DataFrame({"test_set": ["A"], "B": [100.0], "model": ["lookup"], "recipe": ["lookup"]}).assign(
        E_worst=1e-3
    ),
    "key_numbers": pd.DataFrame({"key": ["falls", "ensemble_d4_A"], "this_run": [227.0, 1e-5], "met": [None, "yes"]}),
}


@pytest.mark.parametrize("name", TABLES)
def test_a_run_agrees_with_itself(name):
    """Every comparison of every table is within, at a factor of 1."""
    table = compare(name, TABLES[name], TABLES[name])
    assert len(table) == sum(one.table == name for one in COMPARED) > 0
    assert table["within"].all() and (table["largest_factor"] == 1.0).all()


@pytest.mark.parametrize(
    ("fresh", "within"),
    [
        (trajectories(settling_time=300.0 * (1 + 5e-6)), [True, True]),
        (trajectories(settling_time=300.0 * (1 + 2e-5)), [True, False]),
        (trajectories(settling_time=float("nan")), [True, False]),
        (trajectories(settled_to="W"), [False, True]),
        (reconstruction(pod=0.5 * (1 + 2e-4)), [False, True]),
        (reconstruction(loss=9e-3), [True, True]),
        (reconstruction(loss=0.9e-4), [True, False]),
    ],
)
def test_a_difference_counts_by_its_tolerance(fresh, within):
    """Simulations and POD to the digits, trainings within their factor, in both directions."""
    name = "trajectories" if "settled_to" in fresh else "reconstruction"
    assert compare(name, TABLES[name], fresh)["within"].tolist() == within


def test_a_row_of_one_run_only_is_refused():
    """Another configuration is no comparison."""
    with pytest.raises(InputError, match="is in one of the two runs only"):
        compare("trajectories", trajectories(), trajectories().head(1))


def run(folder, **changed) -> None:
    for name, tables in {"published": TABLES, "fresh": TABLES | changed}.items():
        (folder / name).mkdir()
        for table, rows in tables.items():
            rows.to_csv(folder / name / f"{table}.csv", index=False)
    words = ["--published", folder / "published", "--fresh", folder / "fresh", "-o", folder / "comparison.csv"]
    run_step(compare_published, *words)


def test_the_command_writes_a_row_for_every_comparison(tmp_path):
    """All within: the table is the result."""
    run(tmp_path)
    assert len(pd.read_csv(tmp_path / "comparison.csv")) == len(COMPARED)


def test_the_command_stops_with_what_differs(tmp_path):
    """Table, row, factor and what to do, in one line."""
    with pytest.raises(NumericalError, match=r"trajectories.csv, settling times: 200 1 differs by a factor of 1.1, "):
        run(tmp_path, trajectories=trajectories(settling_time=330.0))
