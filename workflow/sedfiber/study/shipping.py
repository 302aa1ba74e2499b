"""The forecast model that comes with the package: copied from a full run, with a card that says what it is worth.

Beside what every model's card holds, that of the shipped one has three entries: ``made`` (commit,
configuration, versions), ``range`` (what it was trained for) and ``error`` (what it was measured
to be wrong by, on both test sets and at every ℬ of them).
"""

import json
from pathlib import Path
from typing import Any

import pandas as pd

from sedfiber.core.atomic_file import require_folder, write_bytes, write_text
from sedfiber.core.checksum import sha256_of_bytes
from sedfiber.core.csv_file import read_csv
from sedfiber.reduced.dataset import read_dataset
from sedfiber.reduced.model_folder import CARD, WEIGHTS, read_model_folder
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE
from sedfiber.simulation.equilibria.terminal_curve import read_terminal_curve
from sedfiber.study.published import read_manifest, require_committed, require_recorded

MODEL = Path("models/forecast")
SETS = {"A": "trained B at untrained angles", "B": "untrained B at untrained angles"}
MEASURE = (
    "E = E_shape + E_pos as in the tables of the study, both squared; distance: root mean square over the beads, "
    "over L, the fall included; of both, the largest over time"
)
_PACKAGES = ("numpy", "scipy", "torch", "torchdiffeq", "pytorch-optimizer")
_KEY = ["test_set", "B", "angle_index"]


def ship(results: Path, into: Path, repository: Path) -> dict[str, Any]:
    """Copy the forecast model of a full run to ``into``; returns its card.

    Raises InputError, and writes nothing, when the run is not from the committed code or a file is
    not the one that the manifest has the checksum of.
    """
    manifest = read_manifest(results)
    require_committed(manifest["commit"], repository)
    require_recorded(manifest, (f"results/{path}" for path in _sources(manifest)), results)
    return copy_model(results, into, manifest)


def copy_model(results: Path, into: Path, manifest: dict[str, Any]) -> dict[str, Any]:
    """Copy the model of a run that `ship` accepts; the card is written last."""
    card, weights = read_model_folder(results / MODEL, "forecast model")
    curve = (results / MODEL / CURVE).read_bytes()
    scales, hydrodynamics = card["autoencoder"]["scales"], read_terminal_curve(results / MODEL / CURVE).hydrodynamics
    card |= {
        "made": _made(manifest),
        "range": {"hydrodynamics": hydrodynamics, "space": "plane", **scales},
        "error": measured_error(results, manifest["config"]["node"]["forecast_model"]),
        "terminal_curve_sha256": sha256_of_bytes(curve),
    }
    require_folder(into)
    write_bytes(into / WEIGHTS, weights)
    write_bytes(into / CURVE, curve)
    write_text(into / CARD, json.dumps(card, indent=2, sort_keys=True, ensure_ascii=False) + "\n")
    return card


def measured_error(results: Path, model: str) -> dict[str, Any]:
    """A model's errors on the test sets: per set, and per ℬ with the angle of the worst trajectory."""
    by_B = read_csv(results / "tables/baselines.csv")
    by_B = by_B[by_B["model"] == model]
    falls = _falls(results, model, int(by_B["latent_dim"].iloc[0]))
    groups = dict(tuple(falls.groupby(["test_set", "B"])))
    rows = [_of_B(row, groups[row["test_set"], row["B"]]) for row in by_B.to_dict("records")]
    sets = {name: _of_set(name, *(table[table["test_set"] == name] for table in (falls, by_B))) for name in SETS}
    return {"measure": MEASURE, "sets": sets, "by_B": rows}


def _of_B(row: dict[str, Any], falls: pd.DataFrame) -> dict[str, Any]:
    """A row of ``baselines.csv``, and what the falls at that ℬ add to it."""
    kept = {key: row[key] for key in ("test_set", "B", "E_worst", "E_median", "E_ensemble_max")}
    worst = falls.loc[falls["E_max"].idxmax(), "angle_index"]
    return kept | {"angle_index_worst": int(worst), "distance_worst": float(falls["distance"].max())}


def _of_set(name: str, falls: pd.DataFrame, by_B: pd.DataFrame) -> dict[str, Any]:
    return {
        "what": SETS[name],
        "trajectories": len(falls),
        "E_worst": float(falls["E_max"].max()),
        "E_median": float(falls["E_max"].median()),
        "E_ensemble_max": float(by_B["E_ensemble_max"].max()),
        "distance_worst": float(falls["distance"].max()),
        "distance_median": float(falls["distance"].median()),
    }


def _falls(results: Path, model: str, latent_dim: int) -> pd.DataFrame:
    """One row per test trajectory: its largest E, from the table, and its largest distance over L."""
    errors = read_csv(results / "tables/forecast_errors.csv")
    distances = pd.concat([_distances(results, model, name) for name in SETS])
    return errors[errors["latent_dim"] == latent_dim].merge(distances, on=_KEY, validate="1:1")


def _distances(results: Path, model: str, name: str) -> pd.DataFrame:
    steady = results / f"terminal_shapes/{name}.parquet"
    truth = read_dataset(results / f"dataset/{name}.parquet", steady)
    forecast = read_dataset(results / f"forecasts/{model}/{name}.parquet", steady)
    rows = [
        (name, one.B, one.angle_index, largest_distance(one.positions, other.positions, 2.0 * truth.n_beads))
        for one, other in zip(truth, forecast, strict=True)
    ]
    return pd.DataFrame(rows, columns=[*_KEY, "distance"])


def _made(manifest: dict[str, Any]) -> dict[str, Any]:
    """Commit, the configuration that the model depends on, and the versions that trained it."""
    config = manifest["config"]
    model = config["node"]["models"][config["node"]["forecast_model"]]
    return {
        "commit": manifest["commit"],
        "data": {"train": config["study"]["train"], "scene": config["scene"], "simulation": config["simulation"]},
        "autoencoder": config["autoencoders"]["settings"] | {"variant": model["variant"], "seed": model["seed"]},
        "neural_ode": config["node"][model["recipe"]] | {"seed": model["seed"]},
        "python": manifest["python"],
        "packages": {name: manifest["packages"][name] for name in _PACKAGES},
    }


def _sources(manifest: dict[str, Any]) -> list[str]:
    """Every file that the shipped ones are made from, below ``results``."""
    folders = ("dataset", "terminal_shapes", f"forecasts/{manifest['config']['node']['forecast_model']}")
    return [
        *(str(MODEL / name) for name in (WEIGHTS, CARD, CURVE)),
        *(f"tables/{name}.csv" for name in ("forecast_errors", "baselines")),
        *(f"{folder}/{name}.parquet" for folder in folders for name in SETS),
    ]
