"""The study's configuration, validated, and what it asks for in words of the command."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sedfiber.config_schema import validate
from sedfiber.errors import InputError
from sedfiber.learning.settings import NodeSettings

SPLITS = ("train", "A", "B")


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
        if node["forecast_model"] not in node["models"]:
            names = ", ".join(node["models"])
            sys.exit(f"config: node.forecast_model: {node['forecast_model']!r} is not allowed; give one of {names}")
        try:
            NodeSettings(**node["rollout"])
        except InputError as error:
            sys.exit(f"config: node.rollout.{error}")

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
    def _fiber(self) -> dict[str, Any]:
        scene = self.config["scene"]
        return {key: scene[key] for key in ("n_beads", "hydrodynamics")}


def number_name(value: float) -> str:
    """A number as file names hold it: all its digits, no trailing ``.0``."""
    return str(int(value)) if float(value).is_integer() else repr(float(value))


def as_options(values: dict[str, Any]) -> str:
    """``{"n_beads": 31, "json": True}`` as ``--n-beads 31 --json``; what is false is left out."""
    words = [(f"--{key.replace('_', '-')}", value) for key, value in values.items() if value is not False]
    return " ".join(option if value is True else f"{option} {value}" for option, value in words)
