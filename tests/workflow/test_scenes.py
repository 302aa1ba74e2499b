"""The example scenes, the effects and the third dimension: each target runs, and its numbers are right."""

import json
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest

import sedfiber

pytestmark = pytest.mark.slow

EXAMPLES = {
    "study", "volume_disturbed", "shear_tumbling", "extension_buckling", "wall_approach",
    "curved_at_rest", "brownian", "two_fibers", "free_draining",
}  # fmt: skip
ALL = {path.stem for path in (Path(__file__).parents[2] / "scenes").glob("*.yaml")}  # a user's own, too


@pytest.fixture(scope="module")
def drawn(tmp_path_factory, check_out_tiny):
    """All examples run and drawn by `snakemake scenes`."""
    checkout = check_out_tiny(tmp_path_factory.mktemp("scenes") / "study")
    run = checkout.snakemake("-j2", "scenes")
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-4000:]
    return checkout


def test_every_example_has_a_run_and_a_picture(drawn):
    """As many runs and pictures out as files in, the package's own among them."""
    assert ALL >= EXAMPLES
    results = drawn.folder / "results"
    assert {path.stem for path in (results / "scenes").glob("*.parquet")} == ALL
    assert {path.stem for path in (results / "figures/scenes").glob("*.png")} == ALL
    assert {path.stem for path in (results / "figures/scenes").glob("*.svg")} == ALL


def test_every_example_takes_less_than_a_minute(drawn):
    """Their benchmark files say how long each took, start-up included; a factor of two is left for a busy machine."""
    for name in EXAMPLES:
        times = pd.read_csv(drawn.folder / f"results/benchmarks/simulate_scene/{name}.tsv", sep="\t")
        assert times["s"].iloc[0] < 120, name


def test_examples_show_what_they_are_for(drawn):
    """Leaves the plane; tumbles; is pulled straight; rests on the floor; curls over; relaxes."""
    runs = {name: sedfiber.read_trajectory(drawn.folder / f"results/scenes/{name}.parquet") for name in EXAMPLES}
    volume = abs(runs["volume_disturbed"].shape[..., 2]).max(axis=1)
    assert volume[0] < 2.1e-4 and volume.max() > 5.0
    ends = runs["shear_tumbling"].positions[:, -1] - runs["shear_tumbling"].positions[:, 0]
    assert (ends[1:, 0] * ends[:-1, 0] < 0).sum() >= 3  # turns over and over
    last = runs["extension_buckling"].positions[-1]
    assert last[-1, 0] - last[0, 0] == pytest.approx(60, rel=0.02) or last[0, 0] - last[-1, 0] > 58
    floor = runs["wall_approach"].positions[-1, :, 1]
    assert floor.min() > -79.5 and floor.max() < -78.5
    assert runs["curved_at_rest"].shape[0, [0, -1], 1].max() < 0 < runs["curved_at_rest"].shape[-1, [0, -1], 1].min()
    assert abs(runs["free_draining"].shape[-1, :, 1]).max() < 0.05 < abs(runs["free_draining"].shape[0, :, 1]).max()
    assert runs["two_fibers"].positions.shape[1] == 62
    assert runs["study"].settling_time is not None


def test_the_audit_of_all_examples_is_a_table(drawn):
    """One row for each effect left out; the words are fixed, and those of the files."""
    table = pd.read_csv(drawn.folder / "results/tables/scene_audit.csv")
    for row in table.itertuples():
        verdict = "it matters (" if row.matters else "it does not matter ("
        assert row.words.startswith(f"{row.effect}: left out, and {verdict}")
        assert ("): add " in row.words) == row.matters
    facts = json.loads(pq.read_schema(drawn.folder / "results/scenes/study.parquet").metadata[b"sedfiber"])
    assert [v["words"] for v in facts["audit"]] == list(table.loc[table["run"] == "study", "words"])


def test_the_third_dimension_turns_where_it_does(full):
    """The study's fiber: what the eigenvalues predict and the audit says is what runs in volume do, to 0.1 % in ℬ
    about the threshold; each measured rate is the predicted one within 1 %.
    """
    run = full.snakemake("-j2", "third_dimension")
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-4000:]
    table = pd.read_csv(full.folder / "results/tables/third_dimension.csv")
    turn = table.loc[table["place"] == "threshold", "B"].item()
    assert turn == pytest.approx(3699.2, rel=1e-3)
    near, others = table[table["place"] == "threshold"], table[table["place"] != "threshold"]
    assert abs(near["predicted_rate"].item()) < 1e-7
    for column in ("predicted_rate", "audit_rate", "measured_rate"):
        assert ((others[column] > 0) == (others["B"] > turn)).all(), column
    assert (others["audit_matters"] == (others["B"] > turn)).all()
    assert (others["measured_rate"] / others["predicted_rate"]).between(0.99, 1.01).all()
    assert sorted(others.loc[others["place"].notna(), "B"] / turn) == pytest.approx([0.999, 1.001], rel=1e-12)
    assert (full.folder / "results/figures/third_dimension.svg").is_file()
