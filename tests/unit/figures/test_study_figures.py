"""Figures of the study itself, on four falls of seven beads: the right things drawn, bad input refused."""

import json

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgba

from command_line import run_step
from figure_command import draw_words
from sedfiber import Scene, read_trajectory, simulate, write_trajectory
from sedfiber.commands.cli import main
from sedfiber.commands.steps import draw
from sedfiber.core.errors import InputError
from sedfiber.figures.centre_paths import draw_centre_paths
from sedfiber.figures.data_sets import SETS
from sedfiber.figures.data_sets import draw as draw_data_sets
from sedfiber.figures.falls import falls_where, plane_path, plane_shapes, settled_at, snapshots
from sedfiber.figures.problem import LAST, draw_problem
from sedfiber.figures.shapes_by_angle import draw_shapes_by_angle
from sedfiber.figures.shapes_by_flexibility import SNAPSHOTS, draw_shapes_by_flexibility
from sedfiber.figures.style import VERMILION
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.scene.numerics import Numerics

B_VALUES, ANGLES, N = (100, 1000), (0, 12), 7
FIGURES = {
    "problem": ({"fall": "B1000_k12.parquet"}, {}),
    "shapes_by_angle": ({"dataset": "data.parquet"}, {"B": 1000}),
    "centre_paths": ({"dataset": "data.parquet"}, {"B": 1000}),
    "shapes_by_flexibility": ({"dataset": "data.parquet", "regimes": "regimes.csv"}, {"angle_index": 12}),
    "data_sets": ({"table": "trajectories.csv"}, {}),
}
each_figure = pytest.mark.parametrize("figure", FIGURES)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A folder with four falls: each by itself, as a data set, and the two tables of them."""
    folder = tmp_path_factory.mktemp("study")
    runs = [(B, k, str(folder / f"B{B}_k{k}.parquet")) for B in B_VALUES for k in ANGLES]
    for B, k, path in runs:
        call("simulate", "--n-beads", N, "--B", B, "--angle-index", k, "-o", path)
    data, shapes = folder / "data.parquet", folder / "shapes.parquet"
    files = [path for *_, path in runs]
    call("aggregate_dataset", *files, "--settings", '{"split": "train"}', "-o", data)
    call("solve_terminal_shapes", "--settings", json.dumps({"n_beads": N, "B": B_VALUES}), "-o", shapes)
    call("tabulate_regimes", data, shapes, "-o", folder / "regimes.csv")
    call(
        "tabulate_trajectories",
        "--settings",
        json.dumps({"splits": {"train": files}}),
        "-o",
        folder / "trajectories.csv",
    )
    return folder


@pytest.fixture
def falls(study):
    return read_falls(study / "data.parquet")


def call(*words):
    """A command that must succeed."""
    assert main([str(word) for word in words]) == 0


def plot(figure, study, out, settings=None):
    """Draw files of the study; returns the bytes of the SVG and the PNG."""
    inputs, options = settings or FIGURES[figure]
    words = draw_words(figure, out, {name: study / file for name, file in inputs.items()}, options)
    run_step(draw, *words[1:])
    return (out / "x.svg").read_bytes(), (out / "x.png").read_bytes()


def refusal(figure, study, out, settings):
    """The one-line error; nothing may have been written."""
    with pytest.raises(InputError) as caught:
        plot(figure, study, out, settings)
    assert "\n" not in str(caught.value)
    assert not (out / "x.svg").exists() and not (out / "x.png").exists()
    return str(caught.value)


def words_in(figure):
    """Every text of a figure's panels."""
    return [text.get_text() for axes in figure.axes for text in axes.texts]


@each_figure
def test_both_files_are_drawn(figure, study, tmp_path):
    svg, png = plot(figure, study, tmp_path)
    assert svg.startswith(b"<?xml") and png.startswith(b"\x89PNG")


@pytest.mark.parametrize("figure", ["shapes_by_angle", "centre_paths"])
def test_a_number_that_is_not_in_the_data_is_refused(figure, study, tmp_path):
    message = refusal(figure, study, tmp_path, ({"dataset": "data.parquet"}, {"B": 150}))
    assert message == "B: 150 is not in the data set; give one of 100, 1000"


def test_an_angle_that_is_not_in_the_data_is_refused(study, tmp_path):
    inputs, _ = FIGURES["shapes_by_flexibility"]
    message = refusal("shapes_by_flexibility", study, tmp_path, (inputs, {"angle_index": 13}))
    assert message == "angle_index: 13 is not in the data set; give one of 0, 12"


def test_what_is_no_data_set_is_refused(study, tmp_path):
    """A table of text, a file that is not there, a single trajectory."""
    for name, complaint in (
        ("regimes.csv", "cannot read"),
        ("nowhere.parquet", "cannot read"),
        ("B1000_k12.parquet", "lacks the columns split"),
    ):
        assert complaint in refusal("centre_paths", study, tmp_path, ({"dataset": name}, {"B": 1000}))


def test_a_run_that_does_not_settle_is_no_picture_of_the_problem(tmp_path):
    write_trajectory(simulate(Scene(1000, 0.5, N), Numerics(t_end=1.0)), tmp_path / "short.parquet")
    assert "end settled" in refusal("problem", tmp_path, tmp_path, ({"fall": "short.parquet"}, {}))


def test_snapshots_are_even_in_a_steady_motion():
    """A line that moves at a constant speed: even in time and in path alike."""
    t = np.linspace(0.0, 10.0, 101)
    shapes = t[:, None, None] * np.ones((1, 5, 2))
    assert snapshots(t, shapes, 6).tolist() == [0, 20, 40, 60, 80, 100]


def test_a_quick_turn_gets_its_share_of_the_snapshots():
    """All motion within a tenth of the time: half of the pace, so about half of the snapshots."""
    t = np.linspace(0.0, 10.0, 101)
    shapes = np.clip(t, 0.0, 1.0)[:, None, None] * np.ones((1, 5, 2))
    chosen = snapshots(t, shapes, 11)
    assert chosen[0] == 0 and chosen[-1] == 100
    assert (t[chosen] <= 1.0).sum() == 6


def test_the_sketch_has_every_bead_and_says_what_it_leaves_out(study):
    """Start and end have N beads of radius a, the centre one in colour; the end is LAST below the start."""
    run = read_trajectory(study / "B1000_k12.parquet")
    figure = draw_problem(run)
    sketch, whole = figure.axes
    start, end = [group for group in sketch.collections if len(group.get_paths()) == N]
    for group in (start, end):
        colored = [tuple(color) == to_rgba(VERMILION) for color in group.get_facecolor()]
        assert colored == [bead == N // 2 for bead in range(N)]
    middle = [group.get_paths()[N // 2].get_extents() for group in (end, start)]
    assert middle[0].width == pytest.approx(2.0 / (2.0 * N), rel=1e-3)  # 2a in units of L
    drops = sorted(-0.5 * (box.y0 + box.y1) for box in middle)
    assert drops == pytest.approx([0.0, LAST], abs=1e-6)
    fallen = (run.centre[0, 1] - run.centre[-1, 1]) / (2.0 * N)
    assert f"{fallen - LAST:.1f} L left out" in words_in(figure)
    assert sketch.get_aspect() == whole.get_aspect() == 1.0


def test_a_short_fall_is_drawn_whole(study):
    """Nothing is left out of a path that fits the sketch."""
    run = read_trajectory(study / "B1000_k12.parquet")
    cut = type(run)(run.t[:8], run.positions[:8], run.metadata)
    assert not any("left out" in words for words in words_in(draw_problem(cut)))


def test_every_angle_has_its_panel_in_order(falls):
    """All shapes are seen from the centre bead, at one scale; the thick one is the last."""
    chosen = falls_where(falls, "B", 1000)
    figure = draw_shapes_by_angle(chosen)
    panels = figure.axes[: len(ANGLES)]
    assert [axes.get_title().split(",")[0] for axes in panels] == ["k = 0", "k = 12"]
    for axes, fall in zip(panels, chosen, strict=True):
        assert axes.get_aspect() == 1.0
        lines = [line.get_xydata() for line in axes.lines]
        assert all(np.allclose(line[N // 2], 0.0) for line in lines)
        assert np.array_equal(lines[0], plane_shapes(fall)[0])
        assert np.array_equal(lines[-1], plane_shapes(fall)[-1])
        assert f"T ≈ {settled_at(fall)} " in axes.get_title()


def test_the_settling_time_is_rounded_from_the_last_sample(study, falls):
    times = pd.read_csv(study / "trajectories.csv")["settling_time"]
    assert [settled_at(fall) for fall in falls] == times.round().tolist()


def test_paths_start_at_zero_side_by_side(falls):
    """Above: moved apart only, axes equal. Below: all from the origin."""
    chosen = falls_where(falls, "B", 1000)
    upper, lower = draw_centre_paths(chosen).axes
    assert upper.get_aspect() == 1.0 and lower.get_aspect() == "auto"
    above, below = ([line.get_xydata() for line in axes.lines if len(line.get_xdata()) > 1] for axes in (upper, lower))
    deepest = max(-(fall.centre[-1] - fall.centre[0])[1] for fall in chosen)
    for place, fall in enumerate(chosen):
        moved = plane_path(fall) - plane_path(fall)[0]
        assert np.allclose(above[place], moved + np.array([place * deepest, 0.0]))
        assert np.allclose(below[place], np.stack([-moved[:, 1], moved[:, 0]], axis=1))


def test_rows_of_shapes_carry_the_regimes_of_the_table(study, falls):
    """Made-up regimes appear as they are; each row shows its own fall, the start first."""
    chosen = falls_where(falls, "angle_index", 12)
    table = pd.read_csv(study / "regimes.csv").assign(regime=["snaking", "rotation", "bending", "snaking"])
    shapes, angles, _ = draw_shapes_by_flexibility(chosen, table).axes[:3]
    assert [text.get_text() for text in shapes.texts] == ["rotation", "snaking"]
    starts = [line.get_xydata() for line in shapes.lines if len(line.get_xdata()) == N][::SNAPSHOTS]
    for start, fall in zip(starts, chosen, strict=True):
        assert np.allclose(start - start[N // 2], plane_shapes(fall)[0])
    assert starts[0][:, 1].min() > starts[1][:, 1].max()
    turned = np.degrees(table.query("angle_index == 12")["turned_whole"])
    assert angles.lines[0].get_xdata() == pytest.approx(turned.to_numpy())


def test_a_table_without_the_falls_or_with_an_unknown_regime_is_refused(study, falls):
    table, chosen = pd.read_csv(study / "regimes.csv"), falls_where(falls, "angle_index", 12)
    with pytest.raises(InputError, match="no row for B = 1000, angle_index = 12"):
        draw_shapes_by_flexibility(chosen, table.query("B == 100"))
    with pytest.raises(InputError, match="'flying' is not allowed; give one of rotation, bending, snaking"):
        draw_shapes_by_flexibility(chosen, table.assign(regime="flying"))
    with pytest.raises(InputError, match="no column slid_folded"):
        draw_shapes_by_flexibility(chosen, table.drop(columns="slid_folded"))


def data_sets():
    """Three falls, one of each set."""
    rows = [("train", 100.0, 0, 15.4), ("A", 100.0, 1, 250.3), ("B", 150.0, 1, 165.6)]
    return pd.DataFrame(rows, columns=["split", "B", "angle_index", "settling_time"])


def test_every_fall_has_its_cell():
    """k along x, ℬ downwards; letter, colour and rounded time."""
    (axes,) = draw_data_sets(data_sets()).axes
    cells = {text.get_position(): text.get_text() for text in axes.texts}
    assert cells == {(0, 0): "t\n15", (1, 0): "A\n250", (1, 1): "B\n166"}
    colors = {patch.get_xy(): patch.get_facecolor()[:3] for patch in axes.patches}
    for place, split in (((-0.5, -0.5), "train"), ((0.5, -0.5), "A"), ((0.5, 0.5), "B")):
        assert colors[place] == to_rgba(SETS[split][1])[:3]


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (lambda rows: rows.assign(split="C"), "split: 'C' is not allowed; give one of train, A, B"),
        (lambda rows: pd.concat([rows, rows]), "B = 100, angle_index = 0 is in the table twice"),
        (lambda rows: rows.assign(B=None), "must hold a number in every row"),
        (lambda rows: rows.drop(columns="settling_time"), "no column settling_time"),
    ],
)
def test_a_table_that_is_no_grid_is_refused(change, complaint):
    with pytest.raises(InputError, match=complaint) as caught:
        draw_data_sets(change(data_sets()))
    assert "\n" not in str(caught.value)
