"""Films: their frames, size and duration, the same bytes twice, bad input refused in one line."""

import json
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from sedfiber import Scene, simulate, write_trajectory
from sedfiber.commands.cli import main
from sedfiber.figures.falls import plane_shapes
from sedfiber.figures.films.film import FRAMES, frame_samples
from sedfiber.figures.films.forecast import film_forecast
from sedfiber.figures.films.scene import film_scene
from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.scene.numerics import Numerics
from sedfiber.simulation.trajectory import Trajectory, fall_keys

N_BEADS = 7
T = np.arange(0.0, 50.5, 0.5)
WIDTH = 540  # pixels
KINDS = {
    "plane": {},
    "volume": {"space": "volume", "disturbance": {"amplitude": 0.1}},
    "wall seen edge-on": {"space": "volume", "wall": {"point": [0, -40, 0]}},
    "two fibers": {"fibers": [{"place": [0, 0]}, {"place": [0, 20], "theta0": 0.0}]},
    "at rest": {"gravity": None},
}


def fall(aside=0.0):
    """A level straight fiber of test set A that falls by 2 a in a/U_s, moved aside by so many a."""
    positions = np.zeros((len(T), N_BEADS, 3))
    positions[..., 0] = 2.0 * (np.arange(N_BEADS) - N_BEADS // 2) + aside
    positions[..., 1] = -2.0 * T[:, None]
    return Trajectory(T, positions, fall_keys("A", 1000.0, 3, 0.0))


@pytest.fixture
def film(tmp_path):
    """Films the forecast, 1 a aside of the truth; returns the exit status and the file."""
    write_dataset([fall()], tmp_path / "truth.parquet")
    write_dataset([fall(aside=1.0)], tmp_path / "forecast.parquet")

    def run(B="1000", k="3", output="film.webp"):
        files = [str(tmp_path / name) for name in ("truth.parquet", "forecast.parquet", output)]
        words = ["--truth", files[0], "--forecast", files[1], "-o", files[2]]
        return main(["film_forecast", "--settings", json.dumps({"B": B, "angle_index": k}), *words]), tmp_path / output

    return run


def moments(path):
    """Size of a film's frames, how long each is shown in ms, and how often the film runs (0: for ever)."""
    with Image.open(path) as image:
        durations = []
        for frame in range(image.n_frames):
            image.seek(frame)
            image.load()
            durations.append(image.info["duration"])
        return image.size, durations, image.info["loop"]


def test_a_film_has_its_frames_and_loops(film):
    """As many as there may be; the last is shown for a second."""
    status, path = film()
    size, durations, loop = moments(path)
    assert status == 0 and size[0] == WIDTH and loop == 0
    assert len(durations) == FRAMES and durations[-1] == 1000 and set(durations[:-1]) == {60}
    assert path.stat().st_size < 300_000


@pytest.mark.slow
def test_a_film_is_the_same_bytes_twice(film):
    assert film(output="one.webp")[1].read_bytes() == film(output="two.webp")[1].read_bytes()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"B": "999"}, "B: 999 is not in the data set; give one of 1000"),
        ({"k": "4"}, "angle_index: 4 is not in the data set; give one of 3"),
        ({"output": "nowhere/film.webp"}, "does not exist"),
    ],
)
def test_bad_input_is_one_line(film, capsys, words, message):
    status, path = film(**words)
    err = capsys.readouterr().err
    assert status == 1 and message in err and err.count("\n") == 1
    assert not path.exists()


def test_a_forecast_with_other_samples_is_one_line(film, tmp_path, capsys):
    short = replace(fall(), t=T[:-1], positions=fall().positions[:-1])
    write_dataset([short], tmp_path / "forecast.parquet")
    status, path = film()
    err = capsys.readouterr().err
    assert status == 1 and "forecast has shape" in err and err.count("\n") == 1
    assert not path.exists()


def test_the_frame_falls_with_the_true_centre_bead():
    """At every sample the true beads are around zero and the forecast's 1 a aside; E is that of 1 a."""
    film = film_forecast(fall(), fall(aside=1.0))
    clock, true, guess, *_, total = film.moving[:-2]
    for sample in (0, 100):
        film.show(sample)
        np.testing.assert_allclose(true.get_offsets()[N_BEADS // 2], [0.0, 0.0])
        np.testing.assert_allclose(guess.get_offsets() - true.get_offsets(), [[1.0, 0.0]] * N_BEADS)
    assert "fallen 100 a" in clock.get_text()
    np.testing.assert_allclose(total.get_ydata()[1:], 1.0 / (2.0 * T[1:]) ** 2)


def test_the_close_up_is_to_scale():
    """Both axes show as many a on as many pixels, and a bead is 2 a wide: its neighbours touch it."""
    film = film_forecast(fall(), fall())
    axes = film.figure.axes[0]
    across, up = axes.get_window_extent().size
    assert across == pytest.approx(up) and axes.get_xlim() == axes.get_ylim()
    np.testing.assert_allclose(film.moving[1].get_widths(), 2.0)


def test_samples_are_of_the_whole_run_and_none_is_shown_twice():
    samples = frame_samples(T, plane_shapes(fall()))
    assert samples[0] == 0 and samples[-1] == len(T) - 1
    assert (np.diff(samples) > 0).all() and len(samples) <= FRAMES


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_scene_is_filmed(kind, tmp_path):
    """Plane, volume, a wall, several fibers, a run in which nothing moves."""
    run = simulate(Scene(1000, 0.5, N_BEADS, **KINDS[kind]), Numerics(t_end=3))
    write_trajectory(run, tmp_path / "run.parquet")
    film = tmp_path / "film.webp"
    words = [str(tmp_path / "run.parquet"), "--settings", json.dumps({"title": kind}), "-o", str(film)]
    assert main(["film_scene", *words]) == 0
    assert moments(film)[0][0] == WIDTH


def test_volume_has_two_views_and_a_plane_one():
    """And a panel of the end-to-end distance below each."""
    run = simulate(Scene(1000, 0.5, N_BEADS), Numerics(t_end=3))
    assert len(film_scene(run, "").figure.axes) == 2
    run = simulate(Scene(1000, 0.5, N_BEADS, space="volume"), Numerics(t_end=3))
    assert len(film_scene(run, "").figure.axes) == 3


def test_the_wall_stays_where_it_is_while_the_frame_follows_the_fiber():
    """The fiber comes closer to it by as much as it falls."""
    scene = Scene(1000, 0.5, N_BEADS, space="volume", wall={"point": [0, -100, 0]})
    run = simulate(scene, Numerics(t_end=20))
    film = film_scene(run, "")
    wall, beads = film.moving[1], film.moving[2]
    for sample in (0, len(run.t) - 1):
        film.show(sample)
        surface, lowest = wall.get_xy()[:, 1].max(), beads.get_offsets()[:, 1].min()
        assert lowest - surface == pytest.approx(run.positions[sample, :, 1].min() + 100.0)
