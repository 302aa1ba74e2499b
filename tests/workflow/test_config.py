"""config.yaml is validated before any job starts: one line with key, value and what is allowed."""

import ast
import re
import sys
from dataclasses import MISSING, fields
from pathlib import Path

import pytest
import yaml

from sedfiber.commands.cli import STEPS
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings, SourceNodeSettings
from sedfiber.study.code_fingerprint import PACKAGE, command_module, module_sources
from sedfiber.study.hard_cases.listing import CASES

REPOSITORY = Path(__file__).parents[2]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new", "key", "value"),
    [
        ("B: [50, 200], angle_index: [4", "B: [-50, 200], angle_index: [4", "study.train.B.0", "-50"),
        ("B: [50, 200], angle_index: [4", "B: [.nan, 200], angle_index: [4", "study.train.B.0", "nan"),
        ("B: [50, 200], angle_index: [4", "B: [fifty, 200], angle_index: [4", "study.train.B.0", "fifty"),
        ("angle_index: [4, 12, 20]", "angle_index: [4.5, 12, 20]", "study.train.angle_index.0", "4.5"),
        ("angle_index: [8] }", "angle_index: [12] }", "study.A", "B=50"),
        ("n_beads: 7", "n_beads: 8", "scene.n_beads", "8"),
        ("n_beads: 7", "n_beads: 1", "scene.n_beads", "1"),
        ("integrator: LSODA", "integrator: euler", "simulation.integrator", "euler"),
        ("rtol: 1.0e-8", "rtol: 2", "simulation.rtol", "2"),
        ("seed: 0 }", "sede: 0 }", "scene", "sede"),
        ("variants: [none, ", "variants: [nothing, ", "autoencoders.variants.0", "nothing"),
        ("recipe: rollout", "recipe: guess", "node.models.decoder_d2.recipe", "guess"),
        ("forecast_model: decoder_d2", "forecast_model: best", "node.forecast_model", "best"),
        ("rollout_iterations: [10, 10]", "rollout_iterations: [10]", "node.rollout.rollout_iterations", "[10]"),
        ("iterations: 60 }", "iterations: 60, momentum: 1 }", "autoencoders.settings", "momentum"),
        ("figures: { B: 200", "figures: { B: 100", "figures.B", "100"),
    ],
)
def test_a_bad_value_stops_the_workflow_with_one_line(empty, old, new, key, value):
    """No traceback, exit status not 0, nothing written."""
    empty.edit("config.yaml", old, new)
    run = empty.snakemake("-j2")
    lines = [line for line in run.stderr.splitlines() if not line.startswith("Using workflow specific profile")]
    assert run.returncode != 0
    assert len(lines) == 1 and lines[0].startswith(f"config: {key}: "), run.stderr
    assert value in lines[0]
    assert not (empty.folder / "results").exists()


def _described(schema: dict, name: str) -> None:
    for key, value in schema.get("properties", {}).items():
        assert "description" in value or "$ref" in value, f"{name}.{key} has no description"
        _described(value, f"{name}.{key}")


def test_every_key_of_the_schema_is_described():
    """The description completes the sentence that a user reads."""
    schema = yaml.safe_load((REPOSITORY / "workflow/schemas/config.schema.yaml").read_text())
    _described(schema, "config")
    for name, definition in schema["$defs"].items():
        assert definition["description"]
        _described(definition, name)


@pytest.mark.parametrize(
    ("definition", "kind"),
    [
        ("autoencoder_settings", AutoencoderSettings),
        ("rollout_settings", NodeSettings),
        ("source_settings", SourceNodeSettings),
    ],
)
def test_settings_in_schema_and_code_have_the_same_keys(definition, kind):
    """A hyper-parameter that the code knows can be set, and no other."""
    schema = yaml.safe_load((REPOSITORY / "workflow/schemas/config.schema.yaml").read_text())
    known = {field.name for field in fields(kind)}
    assert set(schema["$defs"][definition]["properties"]) == known
    assert all(field.default is not MISSING for field in fields(kind))


def test_the_studys_config_states_every_hyper_parameter():
    """Nothing is hidden in a default: config.yaml is the record of every choice."""
    config = yaml.safe_load((REPOSITORY / "config.yaml").read_text())
    for section, kind in (
        (config["autoencoders"]["settings"], AutoencoderSettings),
        (config["node"]["rollout"], NodeSettings),
        (config["node"]["source"], SourceNodeSettings),
    ):
        assert set(section) == {field.name for field in fields(kind)}


def _environment() -> dict[str, str]:
    """Packages and versions of the conda environment."""
    environment = yaml.safe_load((REPOSITORY / "envs/environment.yaml").read_text())
    return dict(package.split("==") for package in environment["dependencies"][-1]["pip"])


def test_the_conda_environment_agrees_with_the_lock_file():
    """Each package has the version of the lock; torch that of pyproject."""
    lock = (REPOSITORY / "envs/requirements.lock").read_text()
    pinned = dict(re.findall(r"^([A-Za-z0-9_.-]+)==([^ \\\n]+)", lock, re.MULTILINE))
    pinned["torch"] = re.search(r'"torch==([^"]+)"', (REPOSITORY / "pyproject.toml").read_text())[1]
    for name, version in _environment().items():
        assert version == pinned[name]


def test_a_command_depends_on_what_it_imports_and_on_nothing_else():
    """Physics for a simulation, no learning; figures only for plots."""
    names = {str(path.relative_to(PACKAGE)) for path in module_sources(command_module("simulate"))}
    assert {"physics/bending.py", "physics/pair_mobility.py", "scene/scene.py", "commands/simulate.py"} <= names
    assert not any(name.startswith(("reduced", "figures")) for name in names)
    drawn = {str(path.relative_to(PACKAGE)) for path in module_sources("figures.baselines")}
    assert "figures/style.py" in drawn
    assert not any(name.startswith(("reduced", "physics")) for name in drawn)


FIGURES = yaml.safe_load((REPOSITORY / "workflow/report/figures.yaml").read_text(encoding="utf-8"))
# the modules that a command imports by name when it runs
BY_NAME = [f"study.hard_cases.{case.module}" for case in CASES]
BY_NAME += [f"figures.{about.get('module', name)}" for name, about in FIGURES.items()]
# where the import's name is not the package's
OUTSIDE = {"pytorch_optimizer": "pytorch-optimizer", "yaml": "pyyaml", "PIL": "pillow"}


def test_the_conda_environment_holds_what_the_commands_import():
    """Every package outside the standard library that a module of a step, or of simulate, imports."""
    modules = [command_module(command) for command in ("simulate", *STEPS)] + BY_NAME
    for path in {path for module in modules for path in module_sources(module)}:
        foreign = {OUTSIDE.get(name, name) for name in _imported(path) - set(sys.stdlib_module_names)}
        assert foreign - {"sedfiber"} <= set(_environment()), path.name


def _imported(path: Path) -> set[str]:
    """Top-level names of all modules that a file imports."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    plain = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    return {name.split(".")[0] for name in plain | {node.module for node in nodes if isinstance(node, ast.ImportFrom)}}
