"""Forecasts with no model: splines through the training trajectories.

At fixed t and bead the training positions form a table over (ℬ, θ₀). A forecast is the
cubic spline over θ₀ and over ln ℬ, Σ_ij w_i(ln ℬ) v_j(θ₀) X_ij(t). A trajectory that
has ended is carried on by its last shape falling with the steady velocity.
"""

import numpy as np
from scipy.interpolate import make_interp_spline

from sedfiber.core.array_types import Array, History, Positions, Times
from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import Dataset, SettlingFall


class LookupTable:
    """Spline table of a training set whose ℬ and θ₀ form a full grid.

    Raises InputError when they do not, or when the samples are not at the same times.
    """

    def __init__(self, training: Dataset) -> None:
        self.log_B = np.log(training.B_values)
        self.theta0 = np.unique([trajectory.theta0 for trajectory in training])
        self.t = max((trajectory.t for trajectory in training), key=len)
        entries = {(trajectory.B, trajectory.theta0): trajectory for trajectory in training}
        if len(entries) != len(self.log_B) * len(self.theta0):
            raise InputError("the lookup baseline needs every training B at every training theta0")
        velocities = {trajectory.B: trajectory.terminal_velocity for trajectory in training}
        self.velocities = np.array([velocities[B] for B in training.B_values])
        self.table = np.stack(
            [np.stack([_extended(entries[B, theta0], self.t) for theta0 in self.theta0]) for B in training.B_values]
        )

    def forecast(self, B: float, theta0: float, t: Times) -> History:
        """Positions (T, N, 3) at the sample times ``t`` (T,); past the table's end the last shape falls.

        Raises InputError for times that are not the training data's sample times.
        """
        n = min(len(t), len(self.t))
        if not np.allclose(t[:n], self.t[:n], rtol=0, atol=1e-9):
            raise InputError("the lookup baseline knows only the sample times of the training data")
        over_B = spline_weights(self.log_B, np.log(B))
        over_theta0 = spline_weights(self.theta0, theta0)
        known = np.einsum("i,j,ij...->...", over_B, over_theta0, self.table[:, :, :n])
        return np.concatenate([known, _falling(known[-1], over_B @ self.velocities, t[n:] - t[n - 1])])


def spline_weights(nodes: Array, x: float) -> Array:
    """Weights (K,) of the values at ``nodes`` in their cubic spline's value at ``x``.

    The spline is linear in the values, so its weights are the splines of unit vectors; with
    fewer than four nodes the degree is lowered to fit.
    """
    return make_interp_spline(nodes, np.eye(len(nodes)), k=min(3, len(nodes) - 1))(x)


def _extended(trajectory: SettlingFall, t: Times) -> Array:
    """Positions at all of ``t`` (T, N, 3), the last shape falling steadily after the end."""
    n = len(trajectory.t)
    if not np.allclose(trajectory.t, t[:n], rtol=0, atol=1e-9):
        raise InputError(f"the trajectory with {trajectory.name} has other sample times")
    later = _falling(trajectory.positions[-1], trajectory.terminal_velocity, t[n:] - trajectory.t[-1])
    return np.concatenate([trajectory.positions, later])


def _falling(shape: Positions, velocity: Array, after: Times) -> History:
    """``shape`` (N, 3) moved on at ``velocity`` (3,) for each of the times ``after`` (T,)."""
    return shape + after[:, None, None] * velocity
