"""Figures of forecasts: the right trajectories in the right places, bad input refused."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest

from figure_command import draw_words
from sedfiber.commands.cli import main
from sedfiber.core.errors import InputError
from sedfiber.figures.best_and_worst import best_and_worst, pair_up, pairs_of
from sedfiber.figures.contact_sheet import draw_contact_sheet
from sedfiber.figures.forecast_paths import draw_forecast_paths
from sedfiber.figures.forecast_shapes import SNAPSHOTS, draw_forecast_shapes
from sedfiber.figures.lags import draw as draw_lags
from sedfiber.figures.style import BLACK, VERMILION
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.simulation.trajectory import Trajectory, fall_keys

N_BEADS = 7
T = np.arange(0.0, 20.5, 0.5)
SETS = {"A": (100.0, 1000.0), "B": (300.0,)}  # ℬ of each test set
ANGLES = (1, 3, 5)
FIGURES = ("forecast_shapes", "forecast_paths", "contact_sheet")


def fall(split, B, angle_index, lag=0.0):
    """A straight fiber that turns to level within about 5 a/U_s, and so drifts, as it falls."""
    theta0 = angle_index * np.pi / 48
    angle = theta0 * np.exp(-(T - lag) / 5.0)
    along = 2.0 * (np.arange(N_BEADS) - N_BEADS // 2)
    positions = np.stack([np.cos(angle)[:, None] * along, np.sin(angle)[:, None] * along], axis=-1)
    positions += np.stack([-theta0 * T, -4.0 * T], axis=-1)[:, None]
    spatial = np.pad(positions, ((0, 0), (0, 0), (0, 1)))
    return Trajectory(T, spatial, fall_keys(split, B, angle_index, theta0))


def truths():
    return [fall(split, B, k) for split, values in SETS.items() for B in values for k in ANGLES]


def forecasts():
    return [fall(one.split, one.B, one.angle_index, lag=0.3) for one in truths()]


def errors():
    """At every ℬ k = 5 is the best forecast of d = 4 and k = 3 the worst; of d = 2 it is the other way."""
    E_max = {4: {1: 2e-6, 3: 9e-6, 5: 1e-6}, 2: {1: 2e-6, 3: 1e-6, 5: 9e-6}}
    rows = [(d, one.split, one.B, one.angle_index, E_max[d][one.angle_index]) for d in E_max for one in truths()]
    return pd.DataFrame(rows, columns=["latent_dim", "test_set", "B", "angle_index", "E_max"])


def pairs(latent_dim=4):
    return pair_up(truths(), forecasts(), errors(), latent_dim)


def lags():
    """The forecasts of ours are early, those of the paper's recipe late."""
    rows = [
        (model, recipe, 4, one.split, one.B, one.angle_index, lag, 1e-5, 1e-6)
        for model, recipe, lag in (("ours", "rollout", -0.1), ("theirs", "source", 3.0))
        for one in truths()
    ]
    columns = "model recipe latent_dim test_set B angle_index lag E_shape_max E_shape_unlagged"
    return pd.DataFrame(rows, columns=columns.split())


def write_inputs(folder):
    """Data sets, forecasts and table, as the study's rules hand them over; returns their paths by name."""
    for name, falls in (("truth", truths()), ("forecast", forecasts())):
        for split in SETS:
            write_dataset([one for one in falls if one.split == split], folder / f"{name}_{split}.parquet")
    errors().to_csv(folder / "errors.csv", index=False)
    files = [[str(folder / f"{name}_{split}.parquet") for split in SETS] for name in ("truth", "forecast")]
    return {"truth": files[0], "forecasts": files[1], "errors": str(folder / "errors.csv")}


def inputs_of(figure, folder):
    """What one figure takes of them: the shapes are of one test set."""
    inputs = write_inputs(folder)
    if figure == "forecast_shapes":
        inputs |= {name: inputs[name][0] for name in ("truth", "forecasts")}
    return inputs


def plot(folder, figure, inputs, **options):
    """Exit status of the command, its figures in ``folder``."""
    return main(draw_words(figure, folder, inputs, options))


@pytest.mark.parametrize("figure", FIGURES)
def test_both_files_are_drawn(figure, tmp_path):
    assert plot(tmp_path, figure, inputs_of(figure, tmp_path), latent_dim=4) == 0
    assert (tmp_path / "x.svg").read_bytes().startswith(b"<?xml")
    assert (tmp_path / "x.png").read_bytes().startswith(b"\x89PNG")


def test_the_lags_are_drawn(tmp_path):
    lags().to_csv(tmp_path / "lags.csv", index=False)
    assert plot(tmp_path, "lags", {"table": tmp_path / "lags.csv"}, model="ours") == 0
    assert (tmp_path / "x.svg").exists()


@pytest.mark.parametrize("figure", FIGURES)
def test_an_unknown_latent_dimension_is_one_line(figure, tmp_path, capsys):
    assert plot(tmp_path, figure, inputs_of(figure, tmp_path), latent_dim=3) == 1
    message = capsys.readouterr().err
    assert "latent_dim: 3 is not in the table; give one of 2, 4" in message and message.count("\n") == 1
    assert not list(tmp_path.glob("x.*"))


def test_best_and_worst_are_the_least_and_the_greatest_of_the_chosen_model():
    chosen = {B: [pair.truth.angle_index for pair in couple] for B, couple in best_and_worst(pairs(4)).items()}
    assert chosen == {100.0: [5, 3], 300.0: [5, 3], 1000.0: [5, 3]}
    best, worst = best_and_worst(pairs(2))[300.0]
    assert (best.truth.angle_index, worst.truth.angle_index) == (3, 5)


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        ({"forecasts": forecasts()[1:]}, "test set A, B = 100, angle_index = 1 is missing in the forecasts"),
        ({"errors": errors().query("B != 300")}, "test set B, B = 300, angle_index = 1 is missing in the table"),
        ({"errors": errors().drop(columns="E_max")}, "no column E_max"),
        ({"forecasts": [replace(one, positions=one.positions[1:]) for one in forecasts()]}, "other samples"),
    ],
)
def test_inputs_that_do_not_fit_together_are_refused(broken, words):
    given = {"truths": truths(), "forecasts": forecasts(), "errors": errors(), "latent_dim": 4} | broken
    with pytest.raises(InputError, match=words):
        pair_up(**given)


def test_a_set_without_falls_is_refused():
    with pytest.raises(InputError, match="no true fall of test set B"):
        pairs_of([pair for pair in pairs() if pair.truth.split == "A"], "B")


def test_the_shapes_are_those_of_best_and_worst():
    """Per ℬ: nine shapes of k = 5 above nine of k = 3, each true and forecast, in equal aspect; and two E(t)."""
    figure = draw_forecast_shapes(pairs_of(pairs(), "A"))
    shapes, curves = figure.axes[0], figure.axes[1]
    assert len(figure.axes) == 2 * len(SETS["A"])
    drawn = {color: [line for line in shapes.lines if line.get_color() == color] for color in (BLACK, VERMILION)}
    assert {color: sum(len(line.get_xdata()) > 0 for line in lines) for color, lines in drawn.items()} == {
        BLACK: 2 * SNAPSHOTS,
        VERMILION: 2 * SNAPSHOTS,
    }
    assert shapes.get_aspect() == 1.0
    tilts = [np.ptp(drawn[BLACK][k].get_ydata()) for k in (0, SNAPSHOTS)]
    np.testing.assert_allclose(tilts, 12.0 * np.sin(np.array([5, 3]) * np.pi / 48))
    assert [text.get_text().splitlines()[0] for text in shapes.texts] == [
        "best: k = 5, θ₀ = 0.33",
        "worst: k = 3, θ₀ = 0.20",
    ]
    assert curves.get_yscale() == "log" and len(curves.lines[0].get_xdata()) == len(T) - 1


def test_the_paths_start_at_zero_and_do_not_overlap():
    """Both sets, equal aspect, true and forecast at one offset; from left to right by ℬ."""
    figure = draw_forecast_paths(pairs())
    above = figure.axes[0]
    paths = [line for line in above.lines if line.get_color() == BLACK and len(line.get_xdata()) > 2]
    assert above.get_aspect() == 1.0 and len(paths) == 2 * len(SETS["A"])
    assert all(path.get_ydata()[0] == 0.0 for path in paths)
    np.testing.assert_allclose([path.get_ydata()[-1] for path in paths], -80.0)
    edges = [(path.get_xdata().min(), path.get_xdata().max()) for path in paths]
    assert all(right < left for (_, right), (left, _) in pairwise(edges))
    low, high = above.get_xlim()
    assert low < edges[0][0] and edges[-1][1] < high


def test_the_distance_below_the_paths_is_that_of_the_centre_beads():
    """A forecast moved aside by 0.2 a is 0.2 a away at every distance fallen."""
    aside = np.array([0.2, 0.0, 0.0])
    moved = [replace(one, forecast=replace(one.truth, positions=one.truth.positions + aside)) for one in pairs()]
    below = draw_forecast_paths(moved).axes[2]
    for line in below.lines[: 2 * len(SETS["A"])]:
        np.testing.assert_allclose(line.get_ydata(), 0.2)
        np.testing.assert_allclose(line.get_xdata()[[0, -1]], [2.0, 80.0])


def test_the_contact_sheet_has_a_cell_for_every_trajectory():
    """Nine trajectories: rows by ℬ with their set, columns by k; equal errors have one colour, others another."""
    axes = draw_contact_sheet(pairs()).axes[0]
    assert len(axes.patches) == len(truths()) and axes.get_aspect() == 1.0
    assert [label.get_text() for label in axes.get_yticklabels()] == ["100  A", "300  B", "1000  A"]
    assert [label.get_text() for label in axes.get_xticklabels()] == ["k = 1", "k = 3", "k = 5"]
    assert len({patch.get_facecolor() for patch in axes.patches}) == 3


def test_the_lags_shown_are_those_of_the_model_and_of_the_source():
    """Ours at -0.1, the paper's at 3; a tenth of every error is left, on the dashed line."""
    figure = draw_lags(lags(), "ours")
    points = {line.get_label(): line for line in figure.axes[0].lines if len(line.get_xdata())}
    np.testing.assert_allclose(points["this study, d = 4"].get_ydata(), -0.1)
    np.testing.assert_allclose(points["paper's recipe, d = 4"].get_ydata(), 3.0)
    np.testing.assert_allclose(figure.axes[2].lines[0].get_ydata(), 1e-6)


def test_lags_of_an_unknown_model_are_refused():
    with pytest.raises(InputError, match="model: 'nobody' is not allowed; give one of ours, theirs"):
        draw_lags(lags(), "nobody")


def test_an_error_without_a_lag_does_not_stop_the_figure():
    """A wrong shape at rest has no lag: its point is missing above, not below."""
    some = lags()
    some.loc[0, "lag"] = np.nan
    figure = draw_lags(some, "ours")
    assert np.isnan(figure.axes[0].lines[1].get_ydata()).sum() == 1
    assert len(figure.axes[2].lines[0].get_xdata()) == len(SETS["A"]) * len(ANGLES)


@pytest.mark.parametrize("figure", FIGURES)
def test_one_trajectory_of_each_set_is_enough(figure, tmp_path):
    """Best and worst are then the same."""
    inputs = inputs_of(figure, tmp_path)
    few = [fall("A", 100.0, 3), fall("B", 300.0, 3)]
    for one in few:
        for name in ("truth", "forecast"):
            write_dataset([one], tmp_path / f"{name}_{one.split}.parquet")
    assert plot(tmp_path, figure, inputs, latent_dim=4) == 0
