"""Every figure: both files appear, two renders are the same bytes, bad tables are one-line errors."""

from itertools import product
from pathlib import Path

import matplotlib
import pandas as pd
import pytest

from command_line import run_step
from figure_command import draw_words
from sedfiber.commands.steps import draw
from sedfiber.core.errors import InputError

MODELS = (("ours_2", "rollout", 2), ("ours_4", "rollout", 4), ("theirs", "source", 4), ("lookup", "lookup", None))
B_VALUES = {"A": (100, 1000), "B": (150, 700)}


def table(rows: list[tuple], columns: str) -> pd.DataFrame:
    return pd.DataFrame(rows, columns=columns.split())


def reconstruction() -> pd.DataFrame:
    variants = product(("none", "encoder", "decoder", "double"), (1, 2), (0, 1), "AB")
    rows = [("autoencoder", v, d, seed, s, 1e-3 / d * (1 + seed), 2e-3) for v, d, seed, s in variants]
    rows += [("pod", None, d, None, s, 1e-1 / d, 2e-1) for d, s in product((1, 2), "AB")]
    return table(rows, "method variant latent_dim seed test_set loss loss_path_even")


def ensemble_errors() -> pd.DataFrame:
    rows = [
        (model, recipe, d, s, B, time, 3e-5 * time, 1e-5 * time, 2e-5 * time)
        for (model, recipe, d), s in product(MODELS, "AB")
        for B, time in product((*B_VALUES[s], "all"), (0.1, 0.5, 1.0))
    ]
    return table(rows, "model recipe latent_dim test_set B time_fraction E E_shape E_pos")


def baselines() -> pd.DataFrame:
    rows = [
        (s, B, model, recipe, d, 1e-3, 1e-4, 5e-4)
        for (model, recipe, d), s in product(MODELS, "AB")
        for B in B_VALUES[s]
    ]
    return table(rows, "test_set B model recipe latent_dim E_worst E_median E_ensemble_max")


def forecast_errors() -> pd.DataFrame:
    rows = [(d, s, B, k, 1e-5 * k * B) for d, s in product((2, 4), "AB") for B, k in product(B_VALUES[s], (1, 3))]
    return table(rows, "latent_dim test_set B angle_index E_max")


def effects() -> pd.DataFrame:
    rows = [("the study's scene", "runs", "", 1.0, 1.0, 1.0, 0.0, 0.0)]
    rows += [("contact", "runs", "", 1.2, 1.5, 1.1, 1e-6, -2.0), ("Oseen", "refused", "why", *5 * [None])]
    return table(rows, "effect status reason rhs_ratio jacobian_ratio run_ratio shape_change_L speed_change_percent")


# figure: its table, its further options, a column it cannot do without
FIGURES = {
    "reconstruction": (reconstruction, {}, "loss"),
    "forecast_errors": (ensemble_errors, {"model": "ours_4"}, "E_pos"),
    "baselines": (baselines, {}, "E_median"),
    "error_distribution": (forecast_errors, {}, "angle_index"),
    "effects": (effects, {}, "shape_change_L"),
}
each_figure = pytest.mark.parametrize("figure", FIGURES)


def plot(figure: str, data: pd.DataFrame, folder: Path, options: dict | None = None) -> tuple[bytes, bytes]:
    """Draw a table; returns the bytes of its SVG and its PNG."""
    data.to_csv(folder / "table.csv", index=False)
    given = FIGURES[figure][1] if options is None else options
    words = draw_words(figure, folder, {"table": folder / "table.csv"}, given)
    run_step(draw, *words[1:])
    return (folder / "x.svg").read_bytes(), (folder / "x.png").read_bytes()


def refusal(figure: str, data: pd.DataFrame, folder: Path, options: dict | None = None) -> str:
    """The one-line error; nothing may have been written."""
    with pytest.raises(InputError) as caught:
        plot(figure, data, folder, options)
    assert "\n" not in str(caught.value)
    assert [path.name for path in folder.iterdir()] == ["table.csv"]
    return str(caught.value)


@each_figure
def test_both_files_say_nothing_of_the_time_and_the_program(figure, tmp_path):
    svg, png = plot(figure, FIGURES[figure][0](), tmp_path)
    assert svg.startswith(b"<?xml") and b"<dc:date>" not in svg
    assert png.startswith(b"\x89PNG") and b"Software" not in png


@each_figure
def test_a_missing_column_is_named(figure, tmp_path):
    make, _, column = FIGURES[figure]
    assert f"no column {column};" in refusal(figure, make().drop(columns=column), tmp_path)


@each_figure
def test_a_table_without_rows_is_refused(figure, tmp_path):
    assert "no rows" in refusal(figure, FIGURES[figure][0]().head(0), tmp_path)


@pytest.mark.parametrize("figure", [name for name in FIGURES if name != "effects"])
def test_an_unknown_test_set_is_refused(figure, tmp_path):
    assert "test_set: 'C'" in refusal(figure, FIGURES[figure][0]().assign(test_set="C"), tmp_path)


def test_text_in_a_column_of_numbers_is_refused(tmp_path):
    assert "column loss must hold numbers" in refusal("reconstruction", reconstruction().assign(loss="x"), tmp_path)


def test_an_unknown_variant_recipe_or_model_is_refused(tmp_path):
    assert "triple" in refusal("reconstruction", reconstruction().assign(variant="triple"), tmp_path)
    assert "'guess'" in refusal("baselines", baselines().assign(recipe="guess"), tmp_path)
    message = refusal("forecast_errors", ensemble_errors(), tmp_path, {"model": "nobody"})
    assert "'nobody'" in message and "ours_2" in message


def test_user_settings_do_not_reach_the_figures(tmp_path, monkeypatch):
    plain = plot("baselines", baselines(), tmp_path)
    monkeypatch.setitem(matplotlib.rcParams, "axes.facecolor", "red")
    assert plot("baselines", baselines(), tmp_path) == plain


def test_one_trajectory_is_enough(tmp_path):
    single = forecast_errors().query("latent_dim == 2 and B in (100, 150) and angle_index == 1")
    assert plot("error_distribution", single.assign(E_max=1e-4), tmp_path)
    assert plot("forecast_errors", ensemble_errors().query("B in (100, 'all')"), tmp_path)


@each_figure
def test_a_diverged_forecast_does_not_stop_a_figure(figure, tmp_path):
    data, column = FIGURES[figure][0](), FIGURES[figure][2]
    error = column if figure != "error_distribution" else "E_max"
    data.loc[0, error] = float("inf")
    assert plot(figure, data, tmp_path)


def test_a_panel_without_any_error_is_refused(tmp_path):
    only_A = forecast_errors().query("test_set == 'A'")
    assert "latent_dim 2, test_set B" in refusal("error_distribution", only_A, tmp_path)
