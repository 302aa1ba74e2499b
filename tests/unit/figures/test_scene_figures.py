"""Pictures of scenes and of the third dimension: every kind of scene, the same bytes twice, bad input refused."""

import numpy as np
import pandas as pd
import pytest

from figure_command import draw_words
from sedfiber import Scene, simulate, write_trajectory
from sedfiber.commands.cli import main
from sedfiber.figures.scene import draw_scene
from sedfiber.scene.numerics import Numerics

KINDS = {
    "plane": {},
    "volume": {"space": "volume", "disturbance": {"amplitude": 0.1}},
    "wall seen edge-on": {"space": "volume", "wall": {"point": [0, -40, 0]}},
    "oblique wall": {"space": "volume", "wall": {"point": [0, -40, 0], "normal": [0, 1, 1]}},
    "two fibers": {"fibers": [{"place": [0, 0]}, {"place": [0, 20], "theta0": 0.0}]},
    "at rest": {"gravity": None},
}


def draw(folder, run):
    """Both files of one picture, as bytes, by the command."""
    write_trajectory(run, folder / "run.parquet")
    assert main(draw_words("scene", folder, {"run": folder / "run.parquet"}, {"scene": "a_run"})) == 0
    return [(folder / name).read_bytes() for name in ("x.svg", "x.png")]


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_scene_is_drawn(kind, tmp_path):
    """Plane, volume, walls from every side, several fibers, a run in which nothing moves."""
    svg, png = draw(tmp_path, simulate(Scene(1000, 0.5, 7, **KINDS[kind]), Numerics(t_end=3)))
    assert svg.startswith(b"<?xml") and png.startswith(b"\x89PNG")


def test_a_scene_is_drawn_twice_alike(tmp_path):
    """The same bytes."""
    run = simulate(Scene(1000, 0.5, 7, **KINDS["oblique wall"]), Numerics(t_end=3))
    assert draw(tmp_path, run) == draw(tmp_path, run)


def legend_of(figure):
    """The words of a figure's legend."""
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_only_what_is_drawn_stands_in_the_legend():
    """A planar fall has no extent along z, though round-off may have left some; a run that leaves the plane has one."""
    run = simulate(Scene(1000, 0.5, 7), Numerics(t_end=3))
    run.positions[..., 2] += 1e-15 * np.arange(7)
    figure = draw_scene(run, "")
    assert legend_of(figure) == ["fiber", "extent along x", "extent along y"]
    assert {axes.get_yscale() for axes in figure.axes} == {"linear"}
    leaving = simulate(Scene(1000, 0.5, 7, **KINDS["volume"]), Numerics(t_end=3))
    assert legend_of(draw_scene(leaving, ""))[-1] == "extent along z"


def test_growth_out_of_the_plane_is_drawn_on_a_logarithmic_axis():
    """From the least extent there was."""
    run = simulate(Scene(1000, 0.5, 7, **KINDS["volume"]), Numerics(t_end=3))
    run.positions[..., 2] *= np.geomspace(1e-3, 1.0, len(run.t))[:, None]
    assert "log" in {axes.get_yscale() for axes in draw_scene(run, "").axes}


def test_a_run_of_one_sample_is_drawn(tmp_path):
    """The start alone: eight frames of it."""
    assert draw(tmp_path, simulate(Scene(1000, 0.5, 7), Numerics(interval=1.0), t_end=0.5))


def growth_tables(folder, place="threshold"):
    """A made-up threshold between two ℬ."""
    rows = [(1000.0, None, -0.02, -0.02, 7e-5), (3700.0, place, 0.0, 0.0, 7e-5), (9000.0, None, 0.02, 0.02, 7e-5)]
    columns = ["B", "place", "predicted_rate", "measured_rate", "amplitude_start"]
    pd.DataFrame(rows, columns=columns).to_csv(folder / "table.csv", index=False)
    t = np.arange(50.0)
    growth = [pd.DataFrame({"B": B, "t": t, "amplitude": 7e-5 * np.exp(rate * t)}) for B, _, rate, *_ in rows]
    pd.concat(growth).to_csv(folder / "growth.csv", index=False)


def draw_third_dimension(folder):
    """Exit status of the command."""
    return main(draw_words("third_dimension", folder, {"table": folder / "table.csv", "growth": folder / "growth.csv"}))


def test_the_third_dimension_is_drawn(tmp_path):
    """From its two tables alone."""
    growth_tables(tmp_path)
    assert draw_third_dimension(tmp_path) == 0
    assert (tmp_path / "x.svg").exists()


def test_a_table_without_a_threshold_is_refused(tmp_path, capsys):
    """One line; nothing drawn."""
    growth_tables(tmp_path, place="nowhere")
    assert draw_third_dimension(tmp_path) == 1
    assert "place = threshold" in capsys.readouterr().err
    assert not (tmp_path / "x.svg").exists()
