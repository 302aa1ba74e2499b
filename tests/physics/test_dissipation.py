"""Energy: what the fiber loses, the fluid dissipates."""

import numpy as np
import pytest

import reference
from problems import SCENES, bent_chain, system_of
from sedfiber import Scene, simulate


@pytest.mark.parametrize(("space", "hydrodynamics"), SCENES)
@pytest.mark.parametrize("seed", range(3))
def test_energy_is_lost_at_the_rate_of_dissipation(space, hydrodynamics, seed):
    """−dU/dt by a central difference along the flow equals FᵀMF > 0, with U summed in NumPy."""
    system = system_of(space, hydrodynamics)
    x, h = bent_chain(seed, dim=system.shape[1]), 1e-6
    modulus = 24.0 * 11**3 / 1000.0
    u, force = system.velocity(x), system.force(x)
    rate = (reference.total_energy(x + h * u, modulus) - reference.total_energy(x - h * u, modulus)) / (2 * h)
    power = force.ravel() @ system.mobility.matrix(x) @ force.ravel()
    assert power > 0
    assert -rate == pytest.approx(power, rel=1e-6)
    assert system.rhs(0.0, system.to_state(x))[-1] == pytest.approx(power, rel=1e-12)


@pytest.mark.parametrize(("B", "theta0"), [(100, 1.2), (1000, 0.7854), (10000, 0.3)])
def test_energy_falls_at_every_sample(B, theta0):
    """Elastic and gravitational energy together never rise, and the balance holds to 1e-6."""
    scene = Scene(B, theta0)
    trajectory = simulate(scene)
    energy = reference.total_energy(trajectory.positions, scene.modulus)
    assert (np.diff(energy) < 0).all()
    assert trajectory.metadata["checks"]["energy_imbalance"] < 1e-6
