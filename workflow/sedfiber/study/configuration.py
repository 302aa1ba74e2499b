"""The study's configuration, validated, and the settings of each step."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sedfiber.core.errors import InputError
from sedfiber.reduced.training.settings import NodeSettings
from sedfiber.study.config_schema import validate

SPLITS = ("train", "A", "B")
SCENE_NAME = r"\w[\w-]*"  # what rules know for a scene in the names of files


@dataclass(frozen=True)
class Study:
    """The study that ``config.yaml`` describes."""

    config: dict[str, Any]

    splits = SPLITS

    @classmethod
    def from_config(cls, config: dict, schema: Path) -> "Study":
        """Validate against the schema; raises InputError for the first key that is wrong."""
        validate(config, schema)
        study = cls(config)
        study._require_apart()
        study._require_sound_node()
        study._require_shown_fall()
        return study

    def B_values(self, split: str) -> list[str]:
        """The elasto-gravitational numbers of a split, as they stand in file names."""
        return [number_name(B) for B in self.config["study"][split]["B"]]

    def runs(self, split: str) -> list[tuple[str, int]]:
        """Every (ℬ, angle index) of a split."""
        indices = self.config["study"][split]["angle_index"]
        return [(B, k) for B in self.B_values(split) for k in indices]

    def _require_apart(self) -> None:
        """No trajectory may be in two splits: nothing of a test set is ever trained on."""
        seen: dict[tuple[str, int], str] = {}
        for split in SPLITS:
            for B, k in self.runs(split):
                if (B, k) in seen:
                    raise InputError(
                        f"config: study.{split}: B={B} with angle_index {k} is not allowed; "
                        f"it is in {seen[B, k]} already, give each pair to one split"
                    )
                seen[B, k] = split

    def _require_sound_node(self) -> None:
        node = self.config["node"]
        trained = self.config["autoencoders"]["latent_dims"]
        for d in self.config["cost"]["models"]["latent_dims"]:
            if d not in trained:
                allowed = ", ".join(map(str, trained))
                raise InputError(f"config: cost.models.latent_dims: {d} is not allowed; give some of {allowed}")
        if node["forecast_model"] not in node["models"]:
            names = ", ".join(node["models"])
            raise InputError(
                f"config: node.forecast_model: {node['forecast_model']!r} is not allowed; give one of {names}"
            )
        for place, settings in {"node.rollout": node["rollout"], "cost.models.node": self.short_node}.items():
            try:
                NodeSettings(**settings)
            except InputError as error:
                raise InputError(f"config: {place}.{error}") from None

    def _require_shown_fall(self) -> None:
        """The figures of the study show falls that it trains on, as the paper's do."""
        for key, value in self.config["figures"].items():
            trained = self.config["study"]["train"][key]
            if value not in trained:
                raise InputError(
                    f"config: figures.{key}: {value} is not allowed; give one of {', '.join(map(str, trained))}"
                )

    @property
    def shown_fall(self) -> tuple[str, int]:
        """ℬ and angle index of the falls that figures 1 to 4 show."""
        shown = self.config["figures"]
        return number_name(shown["B"]), shown["angle_index"]

    @property
    def simulation_settings(self) -> dict[str, Any]:
        """Options that all runs of ``sedfiber simulate`` share."""
        return self.config["scene"] | self.config["simulation"]

    @property
    def fiber(self) -> dict[str, Any]:
        """Beads and hydrodynamics, as all that the study does without ``simulate`` takes them."""
        scene = self.config["scene"]
        return {key: scene[key] for key in ("n_beads", "hydrodynamics")}

    def terminal_shapes_settings(self, split: str) -> dict[str, Any]:
        """Settings of ``solve_terminal_shapes``."""
        return self.fiber | {"B": self.B_values(split)}

    @property
    def terminal_curve_settings(self) -> dict[str, Any]:
        """Settings of ``solve_terminal_curve``: the range of the training."""
        B = self.config["study"]["train"]["B"]
        return self.fiber | {"B_min": min(B), "B_max": max(B)}

    def autoencoder_settings(self, variant: str, dim: str, seed: str) -> dict[str, Any]:
        """Settings of ``train_autoencoder``."""
        settings = self.config["autoencoders"]["settings"]
        return {"variant": variant, "latent_dim": dim, "seed": seed, "settings": settings}

    def node_settings(self, model: str) -> dict[str, Any]:
        """Settings of ``train_node`` for one of the study's models."""
        node = self.config["node"]["models"][model]
        return {key: node[key] for key in ("recipe", "seed")} | {"settings": self.config["node"][node["recipe"]]}

    def short_node_settings(self, seed: str) -> dict[str, Any]:
        """Settings of ``train_node`` for a model trained in short."""
        return {"recipe": "rollout", "seed": seed, "settings": self.short_node}

    @property
    def key_numbers_settings(self) -> dict[str, Any]:
        """Settings of ``tabulate_key_numbers``: the forecast model, and the angle that the figures show."""
        model = self.config["node"]["forecast_model"]
        variant = self.config["node"]["models"][model]["variant"]
        return {"model": model, "variant": variant, "angle_index": self.config["figures"]["angle_index"]}

    @property
    def integrator_runs(self) -> list[tuple[str, int]]:
        """Every (ℬ, angle index) on which all integrators are timed."""
        cases = self.config["cost"]["integrators"]
        return [(number_name(B), k) for B in cases["B"] for k in cases["angle_index"]]

    def integrator_settings(self, B: str, k: str) -> dict[str, Any]:
        """Settings of ``measure_integrators`` for one fall."""
        given = self.config["cost"]["integrators"] | {"B": B, "angle_index": k}
        return given | {"n_beads": self.config["scene"]["n_beads"]}

    @property
    def trajectories_settings(self) -> dict[str, Any]:
        """Settings of ``measure_trajectories``: every fall of the study."""
        splits = [self.config["study"][split] for split in SPLITS]
        return {"splits": splits, "n_beads": self.config["scene"]["n_beads"]}

    @property
    def short_models(self) -> list[tuple[str, int, int]]:
        """Variant, latent dimension and seed of every neural ODE trained in short."""
        models, seeded = self.config["autoencoders"], self.config["cost"]["models"]
        first = seeded["seeds"][0]
        every = [(variant, d, first) for variant in models["variants"] for d in seeded["latent_dims"]]
        again = [(node["variant"], node["latent_dim"]) for node in self.config["node"]["models"].values()]
        return every + [(*one, seed) for one in dict.fromkeys(again) for seed in seeded["seeds"][1:]]

    @property
    def short_node(self) -> dict[str, Any]:
        """Hyper-parameters of a neural ODE trained in short: the study's with the changes of ``cost.models``."""
        return self.config["node"]["rollout"] | self.config["cost"]["models"]["node"]

    def model_growth_settings(self, n_beads: str) -> dict[str, Any]:
        """Settings of ``measure_model_growth`` at one number of beads."""
        return self.config["cost"]["model_growth"] | {"n_beads": n_beads, "node": self.short_node}


def scene_names(folder: Path) -> list[str]:
    """Names of the scenes in a folder; raises InputError for a file whose name no rule could hold."""
    paths = sorted(path for path in folder.glob("*") if path.suffix in (".yaml", ".yml"))
    for path in paths:
        if path.suffix == ".yml" or not re.fullmatch(SCENE_NAME, path.stem):
            raise InputError(
                f"scenes: {path.name!r} is not allowed; give it a name of letters, digits, _ and - "
                "(not the first) that ends in .yaml"
            )
    return [path.stem for path in paths]


def number_name(value: float) -> str:
    """A number as file names hold it: all its digits, no trailing ``.0``."""
    return str(int(value)) if float(value).is_integer() else repr(float(value))
