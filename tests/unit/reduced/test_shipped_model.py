"""The model that comes with the package is what its card says, and was measured to be as wrong as it says."""

import copy
import json
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from safetensors.numpy import load as load_tensors

from sedfiber import InputError, Scene, load_model, simulate
from sedfiber.core.checksum import sha256_of_bytes
from sedfiber.reduced.forecaster import load_plain_model
from sedfiber.reduced.measures import forecast_error
from sedfiber.reduced.model_folder import SHIPPED, WEIGHTS, read_model_folder
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE
from sedfiber.simulation.equilibria.terminal_curve import read_terminal_curve
from sedfiber.study.angles import angle_of
from sedfiber.study.shipping import SETS, ship

PUBLISHED = Path(__file__).parents[3] / "results/published"
CARD, _ = read_model_folder(SHIPPED, "forecast model")


def disagreements(card: dict) -> list[str]:
    """What a card says that is not so of the weights and the series beside it, or of the published tables."""
    tensors = load_tensors((SHIPPED / WEIGHTS).read_bytes())
    curve = read_terminal_curve(SHIPPED / CURVE)
    manifest = json.loads((PUBLISHED / "manifest.json").read_text(encoding="utf-8"))
    config, made, within = manifest["config"], card["made"], card["range"]
    d, n_beads = card["autoencoder"]["latent_dim"], within["n_beads"]
    train, model = config["study"]["train"], config["node"]["models"][config["node"]["forecast_model"]]
    pairs = {
        "weights": (card["sha256"], sha256_of_bytes((SHIPPED / WEIGHTS).read_bytes())),
        "published weights": (card["sha256"], manifest["sha256"][f"results/models/forecast/{WEIGHTS}"]),
        "terminal curve": (card["terminal_curve_sha256"], sha256_of_bytes((SHIPPED / CURVE).read_bytes())),
        "latent variables": (d, len(tensors["node.latent_scale"])),
        "hidden": (card["neural_ode"]["hidden"], [len(tensors[f"node.network.body.{k}.bias"]) for k in (0, 2)]),
        "beads": (3 * n_beads, tensors["autoencoder.modes"].shape[1]),
        "range": ({key: within[key] for key in card["autoencoder"]["scales"]}, card["autoencoder"]["scales"]),
        "range of B": ([within["B_min"], within["B_max"]], [min(train["B"]), max(train["B"])]),
        "range of theta0": (within["theta0_max"], angle_of(max(train["angle_index"]))),
        "curve": (
            [within["B_min"], within["B_max"], n_beads, within["hydrodynamics"]],
            [curve.B_min, curve.B_max, curve.n_beads, curve.hydrodynamics],
        ),
        "commit": (made["commit"], manifest["commit"]),
        "versions": (
            [made["python"], made["packages"]],
            [manifest["python"], {name: manifest["packages"][name] for name in made["packages"]}],
        ),
        "data": (made["data"], {"train": train, "scene": config["scene"], "simulation": config["simulation"]}),
        "variant": (made["autoencoder"]["variant"], card["autoencoder"]["variant"], model["variant"]),
        "autoencoder": (
            made["autoencoder"],
            config["autoencoders"]["settings"] | {key: model[key] for key in ("variant", "seed")},
        ),
        "seeds": (made["autoencoder"]["seed"], made["neural_ode"]["seed"], card["neural_ode"]["seed"], model["seed"]),
        "neural ODE": (made["neural_ode"], card["notes"]["node_settings"] | {"seed": model["seed"]}),
        "errors": (_without_distances(card["error"]), _published_error(config["node"]["forecast_model"])),
    }
    return [name for name, (first, *others) in pairs.items() if any(other != first for other in others)]


def _without_distances(error: dict) -> dict:
    """The published results have no trajectories to measure distances from; a test below simulates some."""
    rows = [{key: one[key] for key in one if not key.startswith("distance")} for one in error["by_B"]]
    sets = {
        name: {key: one[key] for key in one if not key.startswith(("distance", "what"))}
        for name, one in error["sets"].items()
    }
    return {"sets": sets, "by_B": rows}


@cache
def _published_error(model: str) -> dict:
    """The same from the published tables, to all digits."""
    summary = pd.read_csv(PUBLISHED / "tables/baselines.csv")
    summary = summary[summary["model"] == model]
    every = pd.read_csv(PUBLISHED / "tables/forecast_errors.csv")
    every = every[every["latent_dim"] == summary["latent_dim"].iloc[0]]
    rows = summary[["test_set", "B", "E_worst", "E_median", "E_ensemble_max"]].to_dict("records")
    for row in rows:
        falls = every[(every["test_set"] == row["test_set"]) & (every["B"] == row["B"])].set_index("angle_index")
        row["angle_index_worst"] = falls["E_max"].idxmax()
    sets = {
        name: {
            "trajectories": int((every["test_set"] == name).sum()),
            "E_worst": every.loc[every["test_set"] == name, "E_max"].max(),
            "E_median": every.loc[every["test_set"] == name, "E_max"].median(),
            "E_ensemble_max": summary.loc[summary["test_set"] == name, "E_ensemble_max"].max(),
        }
        for name in SETS
    }
    return {"sets": sets, "by_B": rows}


def numbers_of(value, path=()):
    """Path of every number and word of a card's three entries."""
    if isinstance(value, dict | list):
        items = value.items() if isinstance(value, dict) else enumerate(value)
        return [found for key, inner in items for found in numbers_of(inner, (*path, key))]
    return [path]


def test_card_and_model_agree():
    assert disagreements(CARD) == []


# What nothing beside it tells: words, and distances, which are measured below.
UNTOLD = {"measure", "what", "space", "distance_worst", "distance_median"}
ENTRIES = ("sha256", "terminal_curve_sha256", "range", "made", "error")


def edited(path: tuple) -> dict:
    """The card with one number changed by a little, or one word by a letter."""
    card = copy.deepcopy(CARD)
    *above, last = path
    holder = card
    for key in above:
        holder = holder[key]
    value = holder[last]
    holder[last] = not value if value is True else value + "x" if isinstance(value, str) else value * 1.001 + 1e-12
    return card


def test_a_card_edited_by_hand_fails():
    """Wherever it is edited."""
    paths = [path for entry in ENTRIES for path in numbers_of(CARD[entry], (entry,)) if not set(path) & UNTOLD]
    assert len(paths) > 100
    assert [path for path in paths if not disagreements(edited(path))] == []


def simulated(row: dict):
    """The worst fall of one ℬ, true and forecast by the plain model."""
    truth = simulate(Scene(row["B"], angle_of(row["angle_index_worst"])))
    return truth, load_plain_model().forecast(row["B"], angle_of(row["angle_index_worst"]), truth.t)


CHOSEN = [row for row in CARD["error"]["by_B"] if row["B"] in (1000.0, 4000.0, 300.0)]


@pytest.mark.parametrize("row", CHOSEN, ids=lambda row: f"{row['test_set']}, B = {row['B']:g}")
def test_falls_simulated_now_have_the_cards_error(row):
    """E and distance of the worst trajectory of a ℬ, to 1e-3 of themselves."""
    truth, guess = simulated(row)
    assert forecast_error(truth.positions, guess).total.max() == pytest.approx(row["E_worst"], rel=1e-3)
    assert largest_distance(truth.positions, guess, 62.0) <= row["distance_worst"] * (1 + 1e-3)


def test_distances_of_the_sets_are_those_of_their_rows():
    for name, of_set in CARD["error"]["sets"].items():
        rows = [row["distance_worst"] for row in CARD["error"]["by_B"] if row["test_set"] == name]
        assert of_set["distance_worst"] == max(rows) and 0 < of_set["distance_median"] < of_set["distance_worst"]


def test_the_shipped_model_is_the_default_and_small():
    """A forecast without a folder; less than 300 kB to install."""
    t = np.array([0.0, 10.0])
    assert np.array_equal(load_model().forecast(500, 0.5, t), load_model(SHIPPED).forecast(500, 0.5, t))
    assert sum(path.stat().st_size for path in SHIPPED.iterdir()) < 300_000


def test_a_run_without_manifest_or_of_uncommitted_code_is_not_shipped(tmp_path):
    """One line that says what to do; nothing is written."""
    with pytest.raises(InputError, match="no manifest of a full run"):
        ship(tmp_path, tmp_path / "shipped", tmp_path)
    manifest = {"commit": "abc-dirty", "sha256": {}, "config": {}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(InputError, match="not of committed code"):
        ship(tmp_path, tmp_path / "shipped", tmp_path)
    assert not (tmp_path / "shipped").exists()
