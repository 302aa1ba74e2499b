"""A fiber that is its own mirror image, described by its right half: the same equations, and the symmetry is exact."""

import numpy as np
import pytest

from problems import taylor_slope
from sedfiber import Scene, simulate
from sedfiber.physics.mirror import MirrorSymmetric, whole
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics

SPACES = pytest.mark.parametrize("space", ["plane", "volume"])


def symmetric_shape(dim, seed=3):
    """A bent chain of eleven beads that is its own image, centre bead at the origin; (11, d)."""
    rng = np.random.default_rng(seed)
    right = np.zeros((6, dim))
    right[:, 0] = 2.0 * np.arange(6)
    right[1:] += 0.2 * rng.normal(size=(5, dim))
    return whole(right)


def half_of(space):
    """The equations of a fiber of eleven beads for its right half, and a symmetric state."""
    half = MirrorSymmetric(assemble(Scene(1000.0, 0.0, 11, space=space)))
    return half, half.to_state(symmetric_shape(half.system.shape[1]))


def test_whole_by_hand():
    """The image of (x, y) is (−x, y), the order of the beads reversed; the centre bead is its own."""
    right = np.array([[0.0, 0.0], [2.0, 0.5], [4.0, 1.5]])
    np.testing.assert_array_equal(whole(right), [[-4, 1.5], [-2, 0.5], [0, 0], [2, 0.5], [4, 1.5]])


def test_whole_of_a_history_and_in_volume():
    """Leading axes stay; z is not mirrored."""
    right = np.arange(24.0).reshape(4, 2, 3)
    both = whole(right)
    assert both.shape == (4, 3, 3)
    np.testing.assert_array_equal(both[:, 0], right[:, 1] * [-1, 1, 1])


@SPACES
def test_the_half_moves_as_the_whole_does(space):
    """rhs of the half = rhs of the system, restricted; the system's own is symmetric to round-off."""
    half, y = half_of(space)
    n, d = half.system.shape
    full = half.system.to_state(symmetric_shape(d))
    rates, full_rates = half.rhs(0.0, y), half.system.rhs(0.0, full)
    np.testing.assert_allclose(rates[1:], full_rates[(n // 2) * d + 1 :], rtol=0, atol=1e-15)
    assert rates[0] == 0.0
    assert abs(full_rates[(n // 2) * d]) < 1e-12
    np.testing.assert_allclose(half.to_shapes(y)[:, :d], symmetric_shape(d), rtol=0, atol=0)


@SPACES
def test_jacobian_of_the_half_by_taylor(space):
    """The error of the linear model falls with the square of the step; the centre bead's x stays out of it."""
    half, y = half_of(space)
    direction = np.random.default_rng(5).normal(size=y.size)
    direction[0] = 0.0
    slope = taylor_slope(lambda state: half.rhs(0.0, state), half.jacobian(0.0, y), y, direction, [1e-3, 3e-4, 1e-4])
    assert slope == pytest.approx(2, abs=0.1)


def test_a_symmetric_run_is_its_own_image_to_the_last_bit():
    """ℬ = 10000 without a tilt, where round-off would break the symmetry: every sample is exactly symmetric."""
    shape = simulate(Scene(10_000.0, 0.0, tilt=0.0), Numerics(interval=2.0), t_end=400.0).shape
    np.testing.assert_array_equal(shape[:, ::-1] * [-1, 1, 1], shape)
    assert np.ptp(shape[-1, :, 1]) > 1.0
