import numpy as np
import pytest

from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset
from sedfiber.study.lookup import LookupTable, spline_weights
from tiny_fiber import settling


def test_exact_at_the_nodes(training):
    table = LookupTable(training)
    for one in training:
        np.testing.assert_allclose(table.forecast(one.B, one.theta0, one.t), one.positions, atol=1e-12)


def test_weights_reproduce_a_cubic():
    nodes = np.array([0.0, 0.7, 1.1, 2.0, 3.5])
    assert spline_weights(nodes, 1.7) @ nodes**3 == pytest.approx(1.7**3)


def test_between_the_nodes_it_interpolates(training):
    between = settling(300.0, 9)
    forecast = LookupTable(training).forecast(300.0, between.theta0, between.t)
    assert np.abs(forecast - between.positions).max() < 0.01


def test_ended_trajectory_falls_on_steadily():
    short, long = settling(100.0, 0, duration=6.0), settling(100.0, 6, duration=8.0)
    forecast = LookupTable(Dataset((short, long))).forecast(100.0, 0.0, long.t)
    expected = short.positions[-1] + [0.0, -2.0 * 2.0, 0.0]
    np.testing.assert_allclose(forecast[-1], expected, atol=1e-12)


def test_hole_in_the_grid_is_refused(training):
    with pytest.raises(InputError, match="every training"):
        LookupTable(Dataset(training.trajectories[:-1]))


def test_unknown_sample_times_are_refused(training):
    with pytest.raises(InputError, match="sample times"):
        LookupTable(training).forecast(300.0, 0.1, np.array([0.0, 0.3]))
