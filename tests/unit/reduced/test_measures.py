import numpy as np
import pytest

from sedfiber.core.errors import InputError
from sedfiber.reduced.measures import ensemble_mean, forecast_error, reconstruction_errors

N = 5
LENGTH = 2.0 * N


@pytest.fixture
def falling():
    """A straight fiber that falls by one per sample, (4, N, 3)."""
    positions = np.zeros((4, N, 3))
    positions[:, :, 0] = 2.0 * np.arange(N)
    positions[:, :, 1] = -np.arange(4.0)[:, None]
    return positions


def test_exact_forecast_has_no_error(falling):
    np.testing.assert_array_equal(forecast_error(falling, falling.copy()).total, np.zeros(3))


def test_one_bead_off_by_a_length_counts_one_nth(falling):
    guess = falling.copy()
    guess[2, 0, 0] += LENGTH
    error = forecast_error(falling, guess)
    np.testing.assert_allclose(error.shape, [0, 1 / N, 0], atol=1e-15)
    np.testing.assert_allclose(error.position, 0, atol=1e-15)


def test_position_error_is_relative_to_the_distance_travelled(falling):
    guess = falling.copy()
    guess[1:, :, 0] += 0.1
    error = forecast_error(falling, guess)
    np.testing.assert_allclose(error.position, [0.01, 0.01 / 4, 0.01 / 9], rtol=1e-12)
    np.testing.assert_allclose(error.shape, 0, atol=1e-28)
    np.testing.assert_allclose(error.total, error.position, rtol=1e-12)


def test_forecast_of_another_length_is_refused(falling):
    with pytest.raises(InputError):
        forecast_error(falling, falling[:-1])


def test_ensemble_mean_counts_each_trajectory_until_its_end():
    mean = ensemble_mean([np.array([1.0, 3.0]), np.array([3.0, 5.0, 7.0])])
    np.testing.assert_array_equal(mean, [2.0, 4.0, 7.0])


def test_reconstruction_error_sums_over_coordinates():
    np.testing.assert_allclose(reconstruction_errors(np.zeros((2, 3)), np.array([[1, 2, 2], [0, 0, 0]])), [9, 0])
