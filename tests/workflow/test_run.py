"""A whole tiny study: complete and repeatable."""

import hashlib
import json
import shutil
import subprocess
import sys

import pandas as pd
import pytest
from PIL import Image
from workflow_helpers import REPOSITORY, results_of

import sedfiber
from sedfiber.simulation.differences import largest_distance
from sedfiber.study.shipping import SETS, copy_model

pytestmark = pytest.mark.slow


def test_tables_have_a_row_for_everything(finished):
    """10 runs; 8 autoencoders and 2 PODs on 2 sets; 4 forecasts by each of 3 forecasters."""
    tables = finished.folder / "results/tables"
    trajectories = pd.read_csv(tables / "trajectories.csv")
    assert len(trajectories) == 10
    assert (trajectories["settled_to"] == "U").all()
    assert trajectories["error_estimate"].between(0.0, 1e-5, inclusive="neither").all()
    assert len(pd.read_csv(tables / "reconstruction.csv")) == (8 + 2) * 2
    errors = pd.read_csv(tables / "forecast_errors.csv")
    assert list(errors.columns) == [
        "latent_dim", "test_set", "B", "angle_index",
        "E_max", "E_mean", "E_final", "E_shape_max", "E_pos_max",
    ]  # fmt: skip
    assert len(errors) == 4
    assert set(pd.read_csv(tables / "baselines.csv")["recipe"]) == {"rollout", "source", "lookup"}
    timings = pd.read_csv(tables / "timings.csv").set_index("stage")
    assert timings.loc["simulate", "jobs"] == 10 and timings.loc["train_autoencoder", "jobs"] == 8


def test_published_tables_have_the_columns_of_a_fresh_run(finished):
    """What the repository shows is what this code makes, column by column and table by table."""
    published = {path.name: path for path in (REPOSITORY / "results/published/tables").glob("*.csv")}
    fresh = {path.name: path for path in (finished.folder / "results/tables").glob("*.csv")}
    assert published.keys() == fresh.keys()
    for name, path in fresh.items():
        assert list(pd.read_csv(published[name]).columns) == list(pd.read_csv(path).columns), name


def test_a_run_compares_itself_with_what_was_published(rerun):
    """Within tolerances of itself; a changed settling time stops it with one line."""
    published = rerun.folder / "results/published/tables"
    shutil.copytree(rerun.folder / "results/tables", published)
    assert rerun.snakemake("-j1", "compare_published").returncode == 0
    table = pd.read_csv(rerun.folder / "results/tables/published_comparison.csv")
    assert table["within"].all() and (table["largest_factor"] == 1.0).all()
    runs = pd.read_csv(published / "trajectories.csv")
    runs.loc[(runs["B"] == 50) & (runs["angle_index"] == 4), "settling_time"] *= 1.01
    runs.to_csv(published / "trajectories.csv", index=False)
    failed = rerun.snakemake("-j1", "compare_published")
    assert failed.returncode != 0
    assert "settling times: 50 4 differs by a factor of 1.01, allowed is 1.00001" in failed.stdout + failed.stderr


def test_films_play(rerun):
    """A rule apart from `all`; one film of a test trajectory, with frames enough to see it fall."""
    film = "results/films/A/B50_k8.webp"
    assert rerun.snakemake("-j1", film).returncode == 0
    with Image.open(rerun.folder / film) as frames:
        assert frames.format == "WEBP" and frames.n_frames > 20


def test_the_data_set_reads_as_one_with_split_labels(finished):
    """The three partitions are one Parquet data set."""
    whole = pd.read_parquet(finished.folder / "results/dataset")
    runs = whole.groupby("split").apply(lambda part: len(part.groupby(["B", "angle_index"])))
    assert runs.to_dict() == {"A": 2, "B": 2, "train": 6}


def test_the_manifest_names_every_result_with_its_checksum(finished):
    """Provenance: configuration, lock, versions, rule graph and the sha256 of each output."""
    manifest = json.loads((finished.folder / "results/manifest.json").read_text())
    assert manifest["config"]["scene"]["n_beads"] == 7
    assert manifest["packages"]["numpy"] and manifest["packages"]["torch"]
    assert "simulate -> aggregate_dataset" in manifest["rule_graph"]
    assert "train_autoencoder -> train_node" in manifest["rule_graph"]
    for path, digest in manifest["sha256"].items():
        assert hashlib.sha256((finished.folder / path).read_bytes()).hexdigest() == digest
    assert len(manifest["sha256"]) > 50


def test_the_same_command_twice_gives_the_same_bytes(finished, empty):
    """Parquet, models, tables and figures; times of jobs are the only exception."""
    run = empty.snakemake("-j2")
    assert run.returncode == 0, run.stdout + run.stderr
    first, second = results_of(finished.folder), results_of(empty.folder)
    assert first.keys() == second.keys()
    assert [path for path in first if first[path] != second[path]] == []


def test_costs_are_measured_from_a_finished_study(rerun):
    """Every table with a row for all that was asked, counts beside times; all four figures; and advice from them."""
    run = rerun.snakemake("-j1", "cost")
    assert run.returncode == 0, run.stdout + run.stderr
    results = rerun.folder / "results"
    tables = {path.stem: pd.read_csv(path) for path in (results / "tables").glob("cost_*.csv")}
    rows = {
        "cost_integrators": 13, "cost_trajectories": 10 * 2, "cost_discretisation": 3 * 4, "cost_growth": 0,
        "cost_models": (4 + 1 + 1) * 2, "cost_model_growth": 2 * 10, "cost_choices": 3 * 8, "cost_forecast": 10,
    }  # fmt: skip
    assert {name: len(table) for name, table in tables.items()} == rows
    for table in tables.values():
        assert {"machine", "rhs_unit_s"} <= set(table)
    simulated = tables["cost_forecast"].query("family == 'simulation'").set_index("tolerance")
    assert simulated.loc[1e-5, "error_worst"] < simulated.loc[1e-3, "error_worst"] / 5
    assert simulated.loc[1e-5, "rhs"] > simulated.loc[1e-3, "rhs"] > 100
    figures = {path.stem for path in (results / "figures").glob("cost_*.svg")}
    assert figures == {"cost_integrators", "cost_physics", "cost_models", "cost_decision"}
    advice = [sys.executable, "-m", "sedfiber", "advise", "--B", "100", "--error", "1e-2"]
    told = subprocess.run(advice, cwd=rerun.folder, capture_output=True, text=True, check=True)
    assert "choose simulation by LSODA" in told.stdout


def test_the_trained_model_forecasts_from_command_and_python(finished, tmp_path):
    """The public interface: a file in the simulations' format, and positions (T, N, 3)."""
    folder = finished.folder / "results/models/forecast"
    command = [sys.executable, "-m", "sedfiber", "forecast", "--B", "100", "--theta0", "0.7"]
    subprocess.run([*command, "--model", folder, "-o", tmp_path / "f.parquet", "--t-end", "10"], check=True)
    written = sedfiber.read_trajectory(tmp_path / "f.parquet")
    positions = sedfiber.load_model(folder).forecast(100, 0.7, written.t)
    assert positions.shape == (21, 7, 3)
    assert largest_distance(positions, written.positions, 14.0) < 1e-6  # compiled, and in plain NumPy


def test_the_trained_model_can_be_shipped(finished, tmp_path):
    """With a card that holds the tables' errors, and forecasts like the model that it was copied from."""
    results = finished.folder / "results"
    card = copy_model(results, tmp_path / "shipped", json.loads((results / "manifest.json").read_text()))
    errors = pd.read_csv(results / "tables/forecast_errors.csv")
    for name in SETS:
        chosen = errors[(errors["test_set"] == name) & (errors["latent_dim"] == card["autoencoder"]["latent_dim"])]
        assert card["error"]["sets"][name]["E_worst"] == chosen["E_max"].max()
        assert card["error"]["sets"][name]["trajectories"] == len(chosen)
    ours, theirs = (sedfiber.load_model(folder) for folder in (tmp_path / "shipped", results / "models/forecast"))
    assert abs(ours.forecast(100, 0.7, [0.0, 5.0]) - theirs.forecast(100, 0.7, [0.0, 5.0])).max() == 0.0


def test_forecasts_outside_the_training_range_warn_in_one_line(finished, tmp_path):
    """ℬ = 50 to 200 was trained; 400 is flagged on standard error and in the file."""
    command = [sys.executable, "-m", "sedfiber", "forecast", "--B", "400", "--theta0", "0.7", "--t-end", "5"]
    model = finished.folder / "results/models/forecast"
    run = subprocess.run(
        [*command, "--model", model, "-o", tmp_path / "f.parquet"], capture_output=True, text=True, check=True
    )
    assert run.stderr.count("\n") == 1 and "outside the training range" in run.stderr
    facts = sedfiber.read_trajectory(tmp_path / "f.parquet").metadata
    assert facts["model"]["within_training_range"] is False


def test_a_wrong_model_folder_is_one_line(finished, tmp_path):
    """An autoencoder is not a forecast model, an empty folder is none, half a file is damage."""
    damaged = tmp_path / "damaged"
    damaged.mkdir()
    good = finished.folder / "results/models/forecast"
    (damaged / "card.json").write_bytes((good / "card.json").read_bytes())
    (damaged / "model.safetensors").write_bytes((good / "model.safetensors").read_bytes()[:100])
    for folder in (finished.folder / "results/models/autoencoders/none_d1_s0", tmp_path, damaged):
        command = [sys.executable, "-m", "sedfiber", "forecast", "--B", "100", "--theta0", "0.7"]
        output = tmp_path / "f.parquet"
        run = subprocess.run([*command, "--model", folder, "-o", output], capture_output=True, text=True)
        assert run.returncode == 1 and run.stderr.count("\n") == 1, run.stderr
        assert str(folder) in run.stderr and not output.exists()
