"""What the tests of thermal noise share: warm chains, displacements over a step, averages and their errors."""

from itertools import islice

import numpy as np
import pytest

from sedfiber import Scene
from sedfiber.physics.integrators import StochasticMidpoint, Tolerances

MODULUS = 24.0  # ℰ of the chains below
DIMS = {"plane": 2, "volume": 3}

each_space = pytest.mark.parametrize("space", DIMS)


def integrator_of(system, temperature, step, seed):
    """The stochastic integrator; its tolerances mean nothing."""
    return StochasticMidpoint(system, Tolerances(1e-8, 1e-8), temperature, step, seed)


def chain_scene(n_beads, modulus=MODULUS, temperature=1.0, **parts):
    """A scene of fibers with the given ℰ, without gravity unless it is listed; kT is its noise's."""
    parts = {"gravity": None, "hydrodynamics": "RPY-overlap", "noise": {"peclet": 1.0 / temperature}} | parts
    return Scene(24.0 * n_beads**3 / modulus, 0.3, n_beads, **parts)


def block_average(values, blocks=20):
    """Mean over time, axis 0, and its standard error from blocks much longer than the correlation time."""
    values = values[: len(values) // blocks * blocks]
    means = values.reshape(blocks, -1, *values.shape[1:]).mean(1)
    return means.mean(0), means.std(0, ddof=1) / blocks**0.5


def sample_average(values):
    """Mean of independent draws, axis 0, and its standard error."""
    return values.mean(0), values.std(0, ddof=1) / len(values) ** 0.5


def deviation(measured, expected):
    """Largest distance of a mean from what is expected, in its standard errors."""
    mean, error = measured
    return np.abs((mean - expected) / error).max()


SHORT = 1e-5  # a step so short that its second order, about ℰ Δt, is below every statistical error


def displacements(system, x, temperature, n, seed, step=SHORT):
    """``n`` independent displacements (n, N d) over one step from ``x``."""
    integrator, start = integrator_of(system, temperature, step, seed), system.to_state(x)
    ends = np.array([next(islice(integrator.states(start, step), 1, None)) for _ in range(n)])
    return (system.to_positions(ends)[..., : x.shape[1]] - x).reshape(n, -1)


class LinearMotion:
    """``ẋ = −M K x`` with constant symmetric matrices: what the integrator asks of a system, and of its mobility."""

    needs_lab_frame = False

    def __init__(self, mobility, stiffness):
        self.m, self.k = mobility, stiffness
        self.mobility = self
        self.shape = (len(mobility), 1)

    def matrix(self, x):
        return self.m

    def velocity(self, x, force=None, u=None):
        """The system's velocity, or the mobility's into ``u``."""
        if force is None:
            return -self.m @ self.k @ x
        u[:] = self.m @ force

    def velocity_jacobian(self, x):
        return -self.m @ self.k

    def to_state(self, x):
        return x.ravel().copy()

    def to_positions(self, y):
        return y.reshape(*y.shape[:-1], *self.shape)
