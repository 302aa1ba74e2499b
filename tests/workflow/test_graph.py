"""What the workflow plans: how many jobs, and which ones after a change."""

import pytest

pytestmark = pytest.mark.slow

AFTER_EVERYTHING = {"tabulate_timings", "write_manifest", "show_table", "show_manifest"}
ERRORS = {"tabulate_forecast_errors", "tabulate_lags"}
FORECAST_FIGURES = {
    f"draw_{name}"
    for name in ("forecast_shapes_A", "forecast_shapes_B", "forecast_paths", "forecast_errors", "contact_sheet")
} | {"draw_error_distribution", "draw_baselines", "draw_lags"}
STUDY_FIGURES = {
    f"draw_{name}" for name in ("problem", "shapes_by_angle", "centre_paths", "shapes_by_flexibility", "data_sets")
}
FIGURES = STUDY_FIGURES | {"draw_model_diagram", "draw_reconstruction"} | FORECAST_FIGURES
EXPLORER = {"make_explorer"}
CHOICE = {"solve_terminal_curve", "choose_forecast_model"}
MODELS = {"train_autoencoder", "tabulate_reconstruction", "draw_reconstruction", "train_node"} | CHOICE
FORECASTS = {"forecast_test_set", "forecast_by_lookup"}


def test_the_full_study_has_a_job_for_every_simulation_and_model(full):
    """84 + 77 + 66 = 227 simulations; 4 variants × 6 dimensions × 3 seeds = 72 autoencoders."""
    planned = full.planned()
    assert planned["simulate"] == 227
    assert planned["train_autoencoder"] == 72
    assert planned["train_node"] == 4
    assert planned["forecast_test_set"] == 8
    assert planned["aggregate_dataset"] == planned["solve_terminal_shapes"] == 3


@pytest.mark.parametrize(
    ("target", "last"),
    [
        ("simulations", {"simulate", "tabulate_trajectories", "tabulate_audit"}),
        ("dataset", {"simulate", "aggregate_dataset", "solve_terminal_shapes"}),
        ("autoencoders", {"train_autoencoder", "tabulate_reconstruction"}),
        ("node", {"train_node"} | CHOICE),
        ("forecasts", {"forecast_test_set", "forecast_by_lookup"}),
        ("errors", ERRORS),
        ("figures", FIGURES),
        ("films", {"film_forecast", "film_scene"}),
        ("explorer", EXPLORER),
        ("check_simulations", {"check_simulation", "tabulate_checks"}),
        ("scenes", {"simulate_scene", "draw_scene", "tabulate_scene_audit"}),
        ("third_dimension", {"compare_third_dimension", "draw_third_dimension"}),
        ("states", {"trace_states", "draw_states"}),
        ("hard_cases", {"measure_hard_case", "tabulate_hard_cases", "draw_hard_cases"}),
        ("effects", {"measure_effects", "draw_effects", "benchmark_parts"}),
        ("cost", {"measure_integrators", "measure_trajectories", "measure_discretisation", "measure_choices"}),
        ("cost", {"train_short_node", "measure_models", "measure_model_growth", "tabulate_costs"}),
        ("cost", {"draw_cost_integrators", "draw_cost_physics", "draw_cost_models", "draw_cost_decision"}),
    ],
)
def test_target_rules_make_their_stage(empty, target, last):
    """Each stage can be asked for by name and plans its own rules."""
    planned = empty.planned(target)
    assert last <= set(planned)
    assert not AFTER_EVERYTHING & set(planned)


def test_a_stage_plans_nothing_beyond_itself(empty):
    """Asking for the simulations must not start a training."""
    assert set(empty.planned("simulations")) == {"simulate", "tabulate_trajectories", "tabulate_audit"}
    assert set(empty.planned("scenes")) == {"simulate_scene", "draw_scene", "tabulate_scene_audit"}
    assert set(empty.planned("dataset")) == {"simulate", "aggregate_dataset", "solve_terminal_shapes"}
    assert not {"train_node", "forecast_test_set"} & set(empty.planned("autoencoders"))


def test_a_hard_case_reruns_with_the_module_that_measures_it(empty):
    """The module is imported by name when the case runs; a change of another case's module reruns nothing."""
    result = "results/hard_cases/nonsense_starts.csv"
    run = empty.snakemake("-j1", result)
    assert run.returncode == 0, run.stdout + run.stderr
    empty.append("workflow/sedfiber/study/hard_cases/tolerance_cases.py", "ANOTHER = 1")
    assert empty.planned(result) == {}
    empty.append("workflow/sedfiber/study/hard_cases/start_cases.py", "ANOTHER = 1")
    assert empty.planned(result) == {"measure_hard_case": 1}


def test_every_file_in_scenes_is_a_scene(empty):
    """A user's own file in scenes/ is run and drawn like the examples, with a hyphen in its name too."""
    scenes = empty.folder / "scenes"
    examples = len(list(scenes.glob("*.yaml")))
    assert empty.planned("scenes")["simulate_scene"] == empty.planned("scenes")["draw_scene"] == examples
    text = (scenes / "study.yaml").read_text(encoding="utf-8")
    (scenes / "my-own.yaml").write_text(text.replace("B: 1000", "B: 1200"), encoding="utf-8")
    assert empty.planned("scenes")["simulate_scene"] == examples + 1


@pytest.mark.parametrize("name", ["my.own.yaml", "my own.yaml", "-mine.yaml", "mine.yml"])
def test_a_scene_with_a_name_that_no_rule_knows_is_refused(empty, name):
    """One line before any job starts."""
    (empty.folder / "scenes" / name).write_text("B: 1000\ntheta0: 0.5\n", encoding="utf-8")
    run = empty.snakemake("-n", "scenes")
    lines = [line for line in run.stderr.splitlines() if not line.startswith("Using workflow specific profile")]
    assert run.returncode != 0 and len(lines) == 1
    assert lines[0].startswith(f"scenes: {name!r} is not allowed; give it a name of letters")


def test_a_start_shape_beside_the_scenes_is_an_input(empty):
    """A trajectory to start from as well: the scenes run again when it changes."""
    result = "results/scenes/study.parquet"
    (empty.folder / "scenes/start.parquet").write_bytes(b"one")
    assert empty.snakemake("-j1", result).returncode == 0 and empty.planned(result) == {}
    (empty.folder / "scenes/start.parquet").write_bytes(b"another")
    assert empty.planned(result) == {"simulate_scene": 1}


def test_a_second_run_has_nothing_to_do(finished):
    """The graph is complete: what ran is not planned again."""
    run = finished.snakemake("-j2")
    assert "Nothing to be done" in run.stdout + run.stderr


@pytest.mark.parametrize(
    "path",
    [
        "workflow/sedfiber/physics/bending.py",
        "workflow/sedfiber/reduced/dataset.py",
        "envs/requirements.lock",
        "config.yaml",
        "results/dataset/train.parquet",
        "results/trajectories/B50_k4.parquet",
    ],
)
def test_a_touched_file_reruns_nothing(rerun, path):
    """Inputs are compared by checksum, so a new time stamp alone means nothing."""
    (rerun.folder / path).touch()
    assert rerun.planned() == {}


def test_a_number_written_another_way_reruns_nothing(rerun):
    """1e-8 has no point, and is text to YAML."""
    rerun.edit("config.yaml", "rtol: 1.0e-8, atol: 1.0e-8", "rtol: 1e-8, atol: 10e-9")
    assert rerun.planned() == {}


def test_reworded_comments_and_docstrings_rerun_nothing(rerun):
    """In the module that nearly all others import, in a class, in a function, and in a rule."""
    rerun.edit("workflow/sedfiber/core/errors.py", '"""The errors a user can meet;', '"""Errors that a user may meet;')
    rerun.edit("workflow/sedfiber/core/errors.py", '"""A computation failed:', '"""What was computed failed:')
    rerun.edit("workflow/sedfiber/physics/bending.py", '"""Bending: ', '"""Bending of a fiber: ')
    rerun.append("workflow/sedfiber/physics/system.py", "# a comment")
    rerun.append("workflow/rules/simulations.smk", "# a comment")
    assert rerun.planned() == {}


def test_an_edited_physics_module_reruns_simulations_and_all_that_follows(rerun):
    """Everything but nothing else: ten rules hang on the mechanics."""
    rerun.append("workflow/sedfiber/physics/bending.py", "EDITED = 1")
    planned = rerun.planned()
    assert planned["simulate"] == 10
    assert {"aggregate_dataset", "solve_terminal_shapes"} | MODELS | FORECASTS <= set(planned)
    assert set(planned) >= ERRORS | FIGURES | EXPLORER


def test_an_edited_learning_module_keeps_the_simulations(rerun):
    """Physics knows nothing of learning."""
    rerun.append("workflow/sedfiber/reduced/training/train_autoencoder.py", "EDITED = 1")
    planned = rerun.planned()
    assert not {"simulate", "aggregate_dataset", "forecast_by_lookup"} & set(planned)
    assert planned["train_autoencoder"] == 8


def test_an_edited_figure_module_redraws_only_that_figure(rerun):
    """Tables stay; timings and manifest follow, which hold the figure's time and checksum, and their pages."""
    rerun.append("workflow/sedfiber/figures/baselines.py", "EDITED = 1")
    assert set(rerun.planned()) == {"draw_baselines"} | AFTER_EVERYTHING


def test_the_style_of_figures_redraws_all_of_them(rerun):
    """One style module for all figures, and no table depends on it."""
    rerun.append("workflow/sedfiber/figures/style.py", "EDITED = 1")
    assert set(rerun.planned()) == FIGURES | EXPLORER | AFTER_EVERYTHING


def test_the_neural_odes_learning_rate_reruns_them_and_what_follows(rerun):
    """Only those of our recipe: the paper's has settings of its own."""
    rerun.edit("config.yaml", "matching_iterations: 60", "matching_iterations: 61")
    planned = rerun.planned()
    assert planned["train_node"] == 1
    assert planned["forecast_test_set"] == 2
    assert not (STUDY_FIGURES | {"draw_reconstruction", "train_autoencoder", "simulate"}) & set(planned)
    assert {"choose_forecast_model", "draw_model_diagram", "tabulate_key_numbers"} | EXPLORER <= set(planned)
    assert set(planned) >= ERRORS | FORECAST_FIGURES | AFTER_EVERYTHING


def test_a_changed_test_value_reruns_its_simulations_but_no_training(rerun):
    """ℬ = 100 → 120 in test set B: two simulations, and what uses set B."""
    rerun.edit("config.yaml", "B: { B: [100]", "B: { B: [120]")
    planned = rerun.planned()
    assert planned["simulate"] == 2
    assert planned["aggregate_dataset"] == planned["solve_terminal_shapes"] == 1
    assert planned["forecast_test_set"] == 2 and planned["forecast_by_lookup"] == 1
    assert not {"train_autoencoder", "train_node", "choose_forecast_model"} & set(planned)


def test_a_deleted_trajectory_is_simulated_again(rerun):
    """That job and what follows it."""
    (rerun.folder / "results/trajectories/B50_k4.parquet").unlink()
    planned = rerun.planned()
    assert planned["simulate"] == 1 and planned["aggregate_dataset"] == 1
    assert "solve_terminal_shapes" not in planned


def test_each_figure_is_drawn_alone_from_the_files_that_are_there(rerun):
    """One job and no other, whichever is missing."""
    figures = sorted((rerun.folder / "results/figures").glob("*.svg"))
    assert len(figures) == len(FIGURES)
    for figure in figures:
        figure.unlink()
        name = f"results/figures/{figure.name}"
        assert rerun.planned(name) == {f"draw_{figure.stem}": 1}
