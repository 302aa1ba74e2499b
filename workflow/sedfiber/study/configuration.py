"""The study's configuration, validated, and what it asks for in words of the command."""

import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sedfiber.core.errors import InputError
from sedfiber.reduced.training.settings import NodeSettings
from sedfiber.study.config_schema import validate

SPLITS = ("train", "A", "B")
SCENE_NAME = r"\w[\w-]*"  # what rules know for a scene in the names of files
_RUN_KEYS = ("B", "angle_index")


@dataclass(frozen=True)
class Study:
    """What the workflow needs to know of ``config.yaml``."""

    config: dict[str, Any]

    splits = SPLITS

    @classmethod
    def from_config(cls, config: dict, schema: Path) -> "Study":
        """Validate against the schema; ends the program with one line when a key is wrong."""
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
                    sys.exit(
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
                sys.exit(f"config: cost.models.latent_dims: {d} is not allowed; give some of {allowed}")
        if node["forecast_model"] not in node["models"]:
            names = ", ".join(node["models"])
            sys.exit(f"config: node.forecast_model: {node['forecast_model']!r} is not allowed; give one of {names}")
        for place, settings in {"node.rollout": node["rollout"], "cost.models.node": self.short_node}.items():
            try:
                NodeSettings(**settings)
            except InputError as error:
                sys.exit(f"config: {place}.{error}")

    def _require_shown_fall(self) -> None:
        """The figures of the study show falls that it trains on, as the source's do."""
        for key, value in self.config["figures"].items():
            trained = self.config["study"]["train"][key]
            if value not in trained:
                sys.exit(f"config: figures.{key}: {value} is not allowed; give one of {', '.join(map(str, trained))}")

    @property
    def shown_fall(self) -> tuple[str, int]:
        """ℬ and angle index of the falls that figures 1 to 4 show."""
        shown = self.config["figures"]
        return number_name(shown["B"]), shown["angle_index"]

    @property
    def simulate_options(self) -> str:
        """Options of ``sedfiber simulate`` that all runs share."""
        return as_options(self.config["scene"] | self.config["simulation"])

    @property
    def steady_options(self) -> str:
        """Options of ``sedfiber solve_terminal_shapes``."""
        return as_options(self._fiber)

    @property
    def terminal_curve_options(self) -> str:
        """Options of ``sedfiber solve_terminal_curve``: the range of the training."""
        B = self.config["study"]["train"]["B"]
        return as_options({"B_min": min(B), "B_max": max(B)} | self._fiber)

    @property
    def third_dimension_options(self) -> str:
        """Options of ``sedfiber compare_third_dimension`` but for ℬ."""
        how = {key: value for key, value in self.config["third_dimension"].items() if key != "B"}
        return as_options(self._fiber | how)

    @property
    def states_options(self) -> str:
        """Options of ``sedfiber trace_states``."""
        return as_options(self._fiber | self.config["states"])

    @property
    def effects_options(self) -> str:
        """Options of ``sedfiber measure_effects``."""
        return as_options(self._fiber | self.config["effects"])

    @property
    def integrator_runs(self) -> list[tuple[str, int]]:
        """Every (ℬ, angle index) on which all integrators are timed."""
        cases = self.config["cost"]["integrators"]
        return [(number_name(B), k) for B in cases["B"] for k in cases["angle_index"]]

    @property
    def integrators_options(self) -> str:
        """Options of ``sedfiber measure_integrators`` but for ℬ and k."""
        how = {key: value for key, value in self.config["cost"]["integrators"].items() if key not in _RUN_KEYS}
        return as_options({"n_beads": self.config["scene"]["n_beads"]} | how)

    @property
    def trajectories_options(self) -> str:
        """Options of ``sedfiber measure_trajectories``: every fall of the study."""
        splits = [as_options({key: self.config["study"][split][key] for key in _RUN_KEYS}) for split in SPLITS]
        return " ".join([*splits, as_options({"n_beads": self.config["scene"]["n_beads"]})])

    @property
    def choices_options(self) -> str:
        """Options of ``sedfiber measure_choices`` that say what is tried."""
        return as_options(self.config["cost"]["choices"])

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

    @property
    def model_growth_options(self) -> str:
        """Options of ``sedfiber measure_model_growth`` but for the number of beads and the trainings."""
        given = self.config["cost"]["model_growth"]
        return as_options({key: given[key] for key in ("B", "angle_index", "asked_index", "latent_dim")})

    @property
    def _fiber(self) -> dict[str, Any]:
        scene = self.config["scene"]
        return {key: scene[key] for key in ("n_beads", "hydrodynamics")}


def scene_names(folder: Path) -> list[str]:
    """Names of the scenes in a folder; ends the program with one line where a file's name would make no rule's."""
    paths = sorted(path for path in folder.glob("*") if path.suffix in (".yaml", ".yml"))
    for path in paths:
        if path.suffix == ".yml" or not re.fullmatch(SCENE_NAME, path.stem):
            sys.exit(
                f"scenes: {path.name!r} is not allowed; give it a name of letters, digits, _ and - "
                "(not the first) that ends in .yaml"
            )
    return [path.stem for path in paths]


def number_name(value: float) -> str:
    """A number as file names hold it: all its digits, no trailing ``.0``."""
    return str(int(value)) if float(value).is_integer() else repr(float(value))


def as_options(values: dict[str, Any]) -> str:
    """``{"n_beads": 31, "json": True}`` as ``--n-beads 31 --json``; what is false is left out."""
    words = [(f"--{key.replace('_', '-')}", value) for key, value in values.items() if value is not False]
    return " ".join(option if value is True else f"{option} {_word(value)}" for option, value in words)


def _word(value: Any) -> str:
    return " ".join(map(str, value)) if isinstance(value, list) else str(value)
