"""What a scene means, and which values it refuses."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from sedfiber import InputError, Scene
from sedfiber.scene.assembly import assemble


def test_modulus_and_both_elasto_gravitational_numbers():
    """ℰ = 24 N³/ℬ and W L²/EI = (2/3) ℬ (DESIGN §1): for N = 31, ℬ = 1000 these are 714.984 and 2000/3."""
    scene = Scene(B=1000, theta0=0.7854)
    assert scene.modulus == pytest.approx(714.984, rel=1e-15)
    assert scene.force_consistent_B == pytest.approx(2000 / 3, rel=1e-15)
    assert scene.length == 62.0


def test_assembled_forces_carry_the_modulus():
    """ℬ reaches both elastic forces: a bond of 2.2 a stores 0.01 ℰ, a right angle ℰ/8."""
    system = assemble(Scene(B=648.0, theta0=0.0, n_beads=3))  # ℰ = 24·27/648 = 1
    x = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.2]])
    assert system.energy(x) == pytest.approx(0.01 + 0.125 + 2.2, rel=1e-12)


@pytest.mark.parametrize(("space", "dim"), [("plane", 2), ("volume", 3)])
@pytest.mark.parametrize("theta0", [-2.0, 0.3, math.pi / 3])
def test_start_is_straight_at_the_angle(space, dim, theta0):
    """Beads touch, the centre bead is the origin, and bond 1 points along θ₀."""
    x = Scene(100, theta0, 11, space=space).start()
    assert x.shape == (11, dim)
    assert not x[5].any()
    assert_allclose(
        np.diff(x, axis=0)[:, :2], np.tile([2 * math.cos(theta0), 2 * math.sin(theta0)], (10, 1)), atol=1e-14
    )


@pytest.mark.parametrize("theta0", [math.pi / 2, -math.pi / 2])
def test_vertical_start_is_exactly_vertical(theta0):
    """cos(π/2) is 6e-17 in floating point; such a tilt would grow, so it is not there."""
    assert not Scene(100, theta0).start()[:, 0].any()


def test_horizontal_start_is_tilted_by_the_stated_seeded_angle():
    """θ₀ = 0 exactly becomes ± tilt, the sign from the seed: the same every time, both signs occur."""
    angles = [Scene(100, 0.0, seed=seed).start_angle for seed in range(10)]
    assert {abs(a) for a in angles} == {1e-4}
    assert {math.copysign(1, a) for a in angles} == {-1.0, 1.0}
    assert angles == [Scene(100, 0.0, seed=seed).start_angle for seed in range(10)]


def test_exact_symmetry_on_request():
    """tilt = 0 keeps the horizontal start, whatever the seed."""
    scene = Scene(100, 0.0, tilt=0.0, seed=3)
    assert scene.start_angle == 0.0
    assert not scene.start()[:, 1].any()


def test_other_angles_are_never_tilted():
    """Only exactly θ₀ = 0 is touched."""
    assert Scene(100, 1e-12).start_angle == 1e-12


def test_dict_and_back():
    """A file's metadata rebuilds the scene."""
    scene = Scene(123.0, -0.4, 11, "volume", "RPY-overlap", 2e-4, 7)
    assert Scene.from_dict(scene.to_dict()) == scene


@pytest.mark.parametrize(
    ("values", "named"), [({"B": 1, "theta0": 0, "colour": 3}, "colour"), ({"B": 1}, "theta0"), ({}, "B")]
)
def test_unknown_and_missing_keys_are_named(values, named):
    """One line that names the key."""
    with pytest.raises(InputError, match=f"key '{named}'") as error:
        Scene.from_dict(values)
    assert "\n" not in str(error.value)


def test_text_from_the_command_line_is_converted():
    """A command hands over text; the scene holds numbers."""
    scene = Scene("1e3", "0.5", "31")
    assert (scene.B, scene.theta0, scene.n_beads) == (1000.0, 0.5, 31)
    assert isinstance(scene.n_beads, int)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        *[("B", value) for value in (0, -1, "nan", "inf", float("-inf"), "thousand", None, True, [1.0], "")],
        *[("theta0", value) for value in (45, -3.2, "nan", "inf", "steep", None)],
        *[("n_beads", value) for value in (-31, 0, 2, 30, 31.5, "nan", "many", None)],
        *[("space", value) for value in ("line", "", 3, None)],
        *[("hydrodynamics", value) for value in ("oseen", "rpy", None)],
        *[("tilt", value) for value in (-1e-4, 1.0, "nan")],
        *[("seed", value) for value in (-1, 0.5, "x")],
    ],
)
def test_bad_values_are_refused_by_name(key, value):
    """One line with the key, the value and what is allowed."""
    with pytest.raises(InputError) as error:
        Scene(**({"B": 1000, "theta0": 0.7} | {key: value}))
    message = str(error.value)
    assert message.startswith(f"{key}: {value!r} is not allowed; give ")
    assert "\n" not in message


def test_scene_is_frozen():
    """A scene cannot change under a running simulation."""
    with pytest.raises(AttributeError):
        Scene(1000, 0.7).B = 2.0
