import numpy as np
import pytest

from sedfiber.reduced.scaling import Scales, residual_history
from sedfiber.reduced.training.sampling import path_coordinate, path_even_indices
from tiny_fiber import N_BEADS


def test_scaled_log_spans_the_training_range(training):
    scales = Scales.of(training)
    np.testing.assert_allclose(scales.log_B([100.0, np.sqrt(1e5), 1000.0]), [-1, 0, 1], atol=1e-14)


@pytest.mark.parametrize(("B", "theta0", "inside"), [(100, 0.2, True), (99, 0.2, False), (500, -1.5, False)])
def test_covers_is_the_training_range(training, B, theta0, inside):
    assert Scales.of(training).covers(B, theta0) is inside


def test_residual_is_in_half_lengths_and_vanishes_at_the_terminal_shape(training):
    scales = Scales.of(training)
    one = training.trajectories[1]
    np.testing.assert_allclose(scales.residual(one.terminal + np.array([3.0, 4.0, 5.0]), one.terminal), 0, atol=1e-15)
    moved = one.terminal.copy()
    moved[0, 0] += N_BEADS
    assert scales.residual(moved, one.terminal)[0] == pytest.approx(1.0)


def test_shape_undoes_residual(training):
    scales, one = Scales.of(training), training.trajectories[5]
    shape = scales.shape(residual_history(one, scales), one.terminal)
    centre = one.positions[:, N_BEADS // 2, None]
    np.testing.assert_allclose(shape, one.positions - centre, atol=1e-13)


def test_path_samples_are_even_and_include_both_ends(training):
    scales, one = Scales.of(training), training.trajectories[3]
    path, index = path_coordinate(one, scales), path_even_indices(one, scales, 6)
    assert index[0] == 0 and index[-1] == len(one.t) - 1
    wanted = np.linspace(0, path[-1], 6)
    nearest = np.abs(path[:, None] - wanted).min(axis=0)
    np.testing.assert_allclose(np.abs(path[index] - wanted), nearest, atol=1e-14)


def test_path_samples_crowd_where_the_shape_moves(training):
    scales, one = Scales.of(training), training.trajectories[3]
    steps = np.diff(one.t[path_even_indices(one, scales, 8)])
    assert steps[-1] > 3 * steps[0]
