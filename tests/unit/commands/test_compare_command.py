"""`sedfiber compare` and `sedfiber plot`: any two trajectories, and any one."""

import dataclasses

import numpy as np
import pandas as pd
import pytest
from scipy.interpolate import CubicSpline

from sedfiber import Numerics, Scene, Trajectory, read_trajectory, simulate, write_trajectory
from sedfiber.commands.cli import main
from sedfiber.commands.plot import title_of
from sedfiber.reduced.forecaster import load_plain_model
from sedfiber.reduced.measures import forecast_error
from sedfiber.study.comparison import compare


@pytest.fixture(scope="module")
def fall():
    """Seven beads, 40 units of time."""
    return simulate(Scene(300.0, 0.7, 7), Numerics(t_end=40))


@pytest.fixture(scope="module")
def steeper():
    return simulate(Scene(300.0, 0.75, 7), Numerics(t_end=40))


@pytest.fixture
def command(tmp_path, capsys):
    """Writes two trajectories and compares them; returns status, stdout, stderr and the CSV file."""

    def run(one, other):
        for run, name in ((one, "a"), (other, "b")):
            write_trajectory(run, tmp_path / f"{name}.parquet")
        table = tmp_path / "e.csv"
        words = [str(tmp_path / name) for name in ("a.parquet", "b.parquet")]
        status = main(["compare", *words, "-o", str(table)])
        said = capsys.readouterr()
        return status, said.out, said.err, table

    return run


def late(run, delay):
    """The same fall, of which each sample is shown ``delay`` later, from the start on."""
    shown = np.maximum(run.t - delay, 0.0)
    return dataclasses.replace(run, positions=CubicSpline(run.t, run.positions)(shown))


def test_a_trajectory_against_itself_has_no_error(command, fall):
    status, out, err, table = command(fall, fall)
    assert (status, err) == (0, "") and "largest 0.000e+00" in out and "resampled" not in out
    found = pd.read_csv(table)
    assert list(found) == ["t", "E", "E_shape", "E_pos"] and len(found) == len(fall.t) - 1
    assert (found[["E", "E_shape", "E_pos"]] == 0.0).all(axis=None)


def test_the_error_is_that_of_the_study(command, fall, steeper):
    """As in the tables: E = E_shape + E_pos from the first sample after t = 0; another θ₀ is said to be one."""
    status, out, _, table = command(fall, steeper)
    expected, found = forecast_error(fall.positions, steeper.positions), pd.read_csv(table)
    assert status == 0 and "not of one theta0: 0.7 and 0.75" in out
    np.testing.assert_allclose(found["E"], expected.total, rtol=1e-12)
    np.testing.assert_allclose(found["E_shape"], expected.shape, rtol=1e-12)
    np.testing.assert_array_equal(found["t"], fall.t[1:])
    assert f"E       largest {expected.total.max():.3e} at t = {fall.t[1:][expected.total.argmax()]:g}" in out
    assert f"last {expected.position[-1]:.3e}" in out


def test_a_late_one_is_told_by_how_much(command, fall):
    _, out, _, _ = command(fall, late(fall, 0.4))
    assert "the second is late by 0.4 a/U_s" in out


def test_other_samples_are_resampled_and_said_to_be(command, fall):
    """Every sixth unit against every half: the fall is smooth, so nothing much is left."""
    other = simulate(Scene(300.0, 0.7, 7), Numerics(t_end=40, interval=0.15))
    status, out, _, table = command(fall, other)
    assert status == 0 and "the second resampled at the times of the first" in out
    assert pd.read_csv(table)["E"].max() < 1e-8


def test_the_shorter_one_ends_the_comparison(command, fall):
    """Whichever it is."""
    short = dataclasses.replace(fall, t=fall.t[:21], positions=fall.positions[:21])
    for pair in ((fall, short), (short, fall)):
        status, out, _, table = command(*pair)
        assert status == 0 and "20 samples from t = 0.5 to 10" in out and "resampled" not in out
        assert len(pd.read_csv(table)) == 20


def test_mean_over_the_samples(fall, steeper):
    compared = compare(fall, steeper)
    assert compared.error.total.shape == compared.t.shape and not compared.resampled


def test_what_cannot_be_compared_is_one_line(command, fall):
    """Other beads, several fibers, times that do not meet."""
    nine = simulate(Scene(300.0, 0.7, 9), Numerics(t_end=5))
    two = simulate(Scene(300.0, 0.7, 7, fibers=[{}, {"place": [0, 30]}]), Numerics(t_end=5))
    later = dataclasses.replace(fall, t=fall.t + 100.0)
    cases = [(fall, nine, "1 of 7 beads and 1 of 9"), (two, two, "fibers: 2"), (fall, later, "share 0 samples")]
    for one, other, words in cases:
        status, out, err, table = command(one, other)
        assert status == 1 and out == "" and err.count("\n") == 1 and words in err and not table.exists()


def test_the_error_is_drawn_where_the_output_is_a_picture(fall, steeper, tmp_path):
    """Twice alike; one without any error too."""
    for run, name in ((fall, "a"), (steeper, "b")):
        write_trajectory(run, tmp_path / f"{name}.parquet")
    pictures = []
    for other, name in (("b", "one.png"), ("b", "other.png"), ("a", "none.svg")):
        words = [tmp_path / "a.parquet", tmp_path / f"{other}.parquet", "-o", tmp_path / name]
        assert main(["compare", *map(str, words)]) == 0
        pictures.append((tmp_path / name).read_bytes())
    assert pictures[0] == pictures[1] and pictures[0].startswith(b"\x89PNG") and pictures[2].startswith(b"<?xml")


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_any_trajectory_is_drawn_twice_alike(fall, tmp_path, suffix):
    """By the suffix of the picture's name."""
    write_trajectory(fall, tmp_path / "a.parquet")
    pictures = []
    for name in ("one", "other"):
        picture = tmp_path / f"{name}.{suffix}"
        assert main(["plot", str(tmp_path / "a.parquet"), "-o", str(picture)]) == 0
        pictures.append(picture.read_bytes())
    assert pictures[0] == pictures[1] and pictures[0].startswith({"png": b"\x89PNG", "svg": b"<?xml"}[suffix])


def test_a_picture_without_a_name_has_the_trajectorys(fall, tmp_path, monkeypatch, capsys):
    """In the folder where the user is, and it is said."""
    (tmp_path / "elsewhere").mkdir()
    write_trajectory(fall, tmp_path / "elsewhere/B300_k9.parquet")
    monkeypatch.chdir(tmp_path)
    assert main(["plot", "elsewhere/B300_k9.parquet"]) == 0
    assert capsys.readouterr().out == "drew B300_k9.png\n" and (tmp_path / "B300_k9.png").exists()


def test_a_forecast_is_drawn_and_says_that_it_is_one(tmp_path):
    words = ["--B", "1000", "--theta0", "0.7853981633974483", "-o", str(tmp_path / "f.parquet")]
    assert main(["forecast", *words]) == 0
    title = title_of(read_trajectory(tmp_path / "f.parquet"))
    assert title.startswith("forecast: ") and "= 1000, θ₀ = 0.7854 (45°), settled at t = 1" in title
    assert main(["plot", str(tmp_path / "f.parquet"), "-o", str(tmp_path / "f.png")]) == 0


def test_a_title_tells_of_each_fiber():
    """Their own ℬ and θ₀ where a scene gives them, once where they are alike, only how many where there are many."""

    def told(fibers):
        run = simulate(Scene(1000, 0.5, 5, fibers=fibers), t_end=1.0)
        return title_of(run).removeprefix("simulated: ")

    one, other = (f"$\\mathcal{{B}}$ = {words}°)" for words in ("1000, θ₀ = 0.5 (28.6", "2000, θ₀ = -0.1 (-5.73"))
    assert told([]) == told([{}, {"place": [40, 0]}]) == one
    assert told([{}, {"place": [40, 0], "B": 2000, "theta0": -0.1}]) == f"{one}; {other}"
    assert told([{"place": [40 * k, 0], "B": 1000 + k} for k in range(3)]) == "3 different fibers"


def test_a_title_tells_what_acts_beside_the_studys_effects():
    """And what of them does not."""
    flow = {"name": "shear", "rate": 0.1}
    run = simulate(Scene(1000, 0.5, 5, gravity=None, flow=flow, contact={}), t_end=1.0)
    assert title_of(run).endswith("°), no gravity, shear flow, contact")
    gradient = {"gradient": [[0, 0.1], [0, 0]]}
    assert title_of(simulate(Scene(1000, 0.5, 5, flow=gradient), t_end=1.0)).endswith("°), a linear flow")


def test_a_title_holds_what_a_forecast_was_warned_of():
    far = load_plain_model().settle(50000, 1.5, t_end=1.0)
    first, *doubts = title_of(far).split("\n")
    assert first.startswith("forecast: ") and " ".join(doubts).startswith("not to be relied on: B=50000, theta0=1.5 is")
    assert max(map(len, doubts)) <= 110


def test_what_cannot_be_drawn_is_one_line(fall, tmp_path, capsys):
    """Another kind of picture, a file that tells no scene, none at all."""
    write_trajectory(fall, tmp_path / "a.parquet")
    write_trajectory(Trajectory(fall.t, fall.positions), tmp_path / "bare.parquet")
    cases = [("a", "p.jpg", "ends in .png or"), ("bare", "p.png", "of what scene"), ("none", "p.png", "does not exist")]
    for name, picture, words in cases:
        assert main(["plot", str(tmp_path / f"{name}.parquet"), "-o", str(tmp_path / picture)]) == 1
        err = capsys.readouterr().err
        assert err.count("\n") == 1 and words in err and not (tmp_path / picture).exists()
