"""config.yaml is validated before any job starts: one line with key, value and what is allowed."""

import ast
import re
import sys
from dataclasses import MISSING, fields
from pathlib import Path

import pytest
import yaml

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


@pytest.mark.parametrize("path", sorted(REPOSITORY.glob("envs/*.yaml")), ids=lambda path: path.stem)
def test_conda_environments_agree_with_the_lock_file(path):
    """Each pinned package of an environment has the version of the lock; torch that of pyproject."""
    lock = (REPOSITORY / "envs/requirements.lock").read_text()
    pinned = dict(re.findall(r"^([A-Za-z0-9_.-]+)==([^ \\\n]+)", lock, re.MULTILINE))
    pinned["torch"] = re.search(r'"torch==([^"]+)"', (REPOSITORY / "pyproject.toml").read_text())[1]
    packages = yaml.safe_load(path.read_text())["dependencies"][-1]["pip"]
    for package in packages:
        name, _, version = package.partition("==")
        assert version == pinned[name], f"{path.name} has {package}, the lock {pinned[name]}"


def test_a_command_depends_on_what_it_imports_and_on_nothing_else():
    """Physics for a simulation, no learning; figures only for plots."""
    names = {str(path.relative_to(PACKAGE)) for path in module_sources(command_module("simulate"))}
    assert {"physics/bending.py", "physics/pair_mobility.py", "scene/scene.py", "commands/simulate.py"} <= names
    assert not any(name.startswith(("reduced", "figures")) for name in names)
    drawn = {str(path.relative_to(PACKAGE)) for path in module_sources(command_module("plot_baselines"))}
    assert "figures/style.py" in drawn
    assert not any(name.startswith(("reduced", "physics")) for name in drawn)


# where the import's name is not the package's
OUTSIDE = {"pytorch_optimizer": "pytorch-optimizer", "yaml": "pyyaml", "PIL": "pillow"}


@pytest.mark.parametrize(
    ("environment", "commands"),
    [
        ("simulate", ["simulate", "solve_terminal_shapes", "solve_terminal_curve", "check_simulation"]),
        ("analysis", ["aggregate_dataset", "tabulate_trajectories", "tabulate_timings", "write_manifest"]),
        ("analysis", ["tabulate_audit", "compare_third_dimension", "measure_effects", "benchmark_parts"]),
        ("analysis", ["trace_states", "tabulate_hard_cases", "tabulate_costs"]),
        ("analysis", ["measure_integrators", "measure_trajectories", "measure_discretisation"]),
        ("learning", ["measure_choices", "measure_models", "measure_model_growth"]),
        ("figures", ["plot_cost_integrators", "plot_cost_physics", "plot_cost_models", "plot_cost_decision"]),
        ("figures", ["plot_scene", "plot_effects", "plot_third_dimension", "plot_states", "plot_hard_cases"]),
        ("learning", ["train_autoencoder", "train_node", "forecast_test_set", "tabulate_forecast_errors"]),
        ("learning", ["measure_hard_case"]),
        ("learning", ["tabulate_lags"]),
        ("analysis", ["tabulate_regimes", "tabulate_key_numbers", "show_table", "show_manifest", "compare_published"]),
        ("figures", ["plot_problem", "plot_shapes_by_angle", "plot_centre_paths", "plot_shapes_by_flexibility"]),
        ("figures", ["plot_data_sets", "plot_model_diagram", "plot_reconstruction", "plot_forecast_errors"]),
        ("figures", ["plot_forecast_shapes", "plot_forecast_paths", "plot_contact_sheet", "plot_lags"]),
        ("figures", ["plot_baselines", "plot_error_distribution", "film_forecast", "film_scene"]),
        ("figures", ["make_explorer"]),
    ],
)
def test_conda_environments_hold_what_their_commands_import(environment, commands):
    """Every package outside the standard library that a command's modules import."""
    listed = yaml.safe_load((REPOSITORY / f"envs/{environment}.yaml").read_text())["dependencies"][-1]["pip"]
    available = {package.partition("==")[0] for package in listed}
    for command in commands:
        by_name = [f"study.hard_cases.{case.module}" for case in CASES] if command == "measure_hard_case" else []
        for path in {
            *module_sources(command_module(command)),
            *(path for module in by_name for path in module_sources(module)),
        }:
            foreign = {OUTSIDE.get(name, name) for name in _imported(path) - set(sys.stdlib_module_names)}
            assert foreign - {"sedfiber"} <= available, f"{path.name} of {command}"


def _imported(path: Path) -> set[str]:
    """Top-level names of all modules that a file imports."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    plain = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    return {name.split(".")[0] for name in plain | {node.module for node in nodes if isinstance(node, ast.ImportFrom)}}
