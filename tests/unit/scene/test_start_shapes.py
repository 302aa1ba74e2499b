"""Where the beads are at the start: shapes, rest shapes, disturbances, several fibers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scene_examples import BASE, refusal

from sedfiber import Scene, simulate, write_trajectory
from sedfiber.physics.curved_bending import rest_arc

ROWS = [[2.0 * k, 0.3 * k * k] for k in range(5)]


def turned(x, angle):
    """Rows (N, 2) turned about the centre bead by ``angle``."""
    c, s = math.cos(angle), math.sin(angle)
    return (np.array(x) - x[2]) @ np.array([[c, s], [-s, c]])


@pytest.mark.parametrize("angle", [0.0, 0.7, -2.0])
def test_start_shapes(tmp_path, angle):
    """Rows, an array, .csv, .npy and a trajectory's last sample are one start, turned by θ₀, never tilted."""
    np.savetxt(tmp_path / "x.csv", ROWS, delimiter=",")
    np.save(tmp_path / "x.npy", ROWS)
    run = simulate(Scene(100, 0.7, 5), t_end=1.0)
    run.positions[-1] = np.column_stack([ROWS, np.zeros(5)])
    write_trajectory(run, tmp_path / "x.parquet")
    files = [{"file": str(tmp_path / f"x.{kind}")} for kind in ("csv", "npy", "parquet")]
    for shape in (ROWS, tuple(map(tuple, ROWS)), np.array(ROWS), *files):
        scene = Scene(1000, angle, 5, shape=shape)
        assert_allclose(scene.start(), turned(ROWS, angle), rtol=0, atol=1e-14)
        assert scene.start_angle == angle
    (tmp_path / "empty.npy").touch()
    assert refusal(shape={"file": str(tmp_path / "empty.npy")}).startswith("shape.file: cannot read ")
    spatial = np.column_stack([ROWS, [1.0, 0.0, 5.0, 0.0, 2.0]])
    x = Scene(1000, angle, 5, space="volume", shape=spatial).start()
    assert_allclose(x, np.column_stack([turned(ROWS, angle), spatial[:, 2] - 5.0]), rtol=0, atol=1e-14)


@pytest.mark.parametrize("shape", ["rest", "straight", None])
def test_rest_shape_of_a_curved_fiber(shape):
    """ "rest" is the arc of its curvature turned by θ₀; a straight start stays straight, bonds of length 2."""
    x = Scene(1000, 0.7, 11, bending={"curvature": 0.1}, shape=shape).start()
    arc = rest_arc(11, 0.1 if shape == "rest" else 0.0, 2)
    assert_allclose(x, arc @ np.array([[math.cos(0.7), math.sin(0.7)], [-math.sin(0.7), math.cos(0.7)]]), atol=1e-13)
    assert_allclose(np.linalg.norm(np.diff(x, axis=0), axis=1), 2.0, rtol=1e-14)


@pytest.mark.parametrize("shape", ["arc", 3, [[0, 0, 0, 0]] * 5, [[1, 2], [3]], [[0, math.nan]] * 5, {"fil": "x.csv"}])
def test_bad_shapes_are_refused(shape):
    """One line with what a shape may be."""
    line = refusal(shape=shape)
    assert line.startswith("shape: ") and "give straight, rest, {file: PATH}, or 5 rows of 2 or 3 finite" in line


@pytest.mark.parametrize("rows", [1, 4, 21])
def test_a_shape_of_another_number_of_beads_is_told_by_its_rows(rows):
    """Not by its numbers, of which there are too many."""
    line = refusal(shape=[[2.0 * k, 0.0] for k in range(rows)])
    assert line == f"shape: a row count of {rows} is not allowed; give 5 rows, one a bead (n_beads)"


@given(seed=st.integers(0, 10**6), amplitude=st.floats(0.0, 0.5))
def test_disturbance_is_seeded_and_bounded(seed, amplitude):
    """In the plane x and y move, out of it z, every bead within ± amplitude, the same for the same seed."""
    for space, direction, moved in (("plane", "in-plane", [0, 1]), ("volume", "in-plane", [0, 1]),
                                    ("volume", "out-of-plane", [2])):  # fmt: skip
        part = {"amplitude": amplitude, "direction": direction}
        values = BASE | {"space": space, "seed": seed, "hydrodynamics": "RPY-overlap"}
        x, again = (Scene(**values, disturbance=part).start() for _ in range(2))
        moves = x - Scene(**values).start()
        assert np.array_equal(x, again)
        assert abs(moves).max() <= amplitude + 1e-15
        still = [k for k in range(x.shape[1]) if k not in moved]
        assert not moves[:, still].any() and (amplitude < 1e-9 or moves[:, moved].all())
        other = Scene(**(values | {"seed": seed + 1}), disturbance=part).start()
        assert amplitude < 1e-9 or not np.array_equal(other, x)


def test_several_fibers_have_their_own_places_angles_and_moduli():
    """What a fiber leaves out is the scene's; an exactly horizontal one is tilted like a single one."""
    fibers = [{}, {"place": [40, 0], "theta0": -0.3}, {"place": [0, 40], "B": 500}, {"place": [0, -40], "theta0": 0}]
    scene = Scene(**BASE, fibers=fibers)
    x = scene.start().reshape(4, 5, 2)
    assert_allclose(x[:, 2], [[0, 0], [40, 0], [0, 40], [0, -40]], atol=1e-14)
    bonds = np.diff(x, axis=1)
    angles = np.arctan2(bonds[..., 1], bonds[..., 0])
    assert_allclose(angles, np.repeat([[0.7], [-0.3], [0.7], [angles[3, 0]]], 4, axis=1), rtol=0, atol=1e-13)
    assert abs(angles[3, 0]) == pytest.approx(1e-4)
    assert scene.n_fibers == 4
    assert scene.moduli == pytest.approx([3.0, 3.0, 6.0, 3.0])


def test_large_seeds_are_kept_to_the_last_digit():
    """Two seeds that a double would take for one draw different disturbances."""
    seeds = (2**60, 2**60 + 1)
    starts = [Scene(1, 0.5, 5, seed=s, disturbance={"amplitude": 0.1, "direction": "in-plane"}).start() for s in seeds]
    assert not np.array_equal(*starts)
