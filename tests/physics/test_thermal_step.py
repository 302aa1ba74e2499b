"""Thermal noise over one step: covariance and mean of the displacement, with the drift of a varying mobility.

Expected numbers are closed forms and the mobility of ``reference``.  Every seed is fixed, so a test has the
same outcome in every run; tolerances are in standard errors.
"""

import numpy as np
import pytest

import reference
from problems import bent_chain
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.scene.assembly import assemble
from thermal import DIMS, MODULUS, SHORT, chain_scene, deviation, displacements, sample_average

WALL = {"point": (0.0, -60.0, 0.0), "normal": (2 / 3, 2 / 3, 1 / 3)}
PLACES = {"plane": ("plane", None), "volume": ("volume", None), "near a wall": ("volume", WALL)}

each_place = pytest.mark.parametrize("place", PLACES)


def bent_chain_in(place):
    """Five beads with overlaps, and gravity, springs and bending: system and positions, the lowest 1.2 above a wall."""
    space, wall = PLACES[place]
    x = bent_chain(5, 5, DIMS[space], bend=0.6, stretch=0.15)
    scene = chain_scene(5, space=space, wall=wall, gravity={})
    if wall is not None:
        normal = np.array(WALL["normal"])
        x = x + (1.2 - ((x - np.array(WALL["point"])) @ normal).min()) * normal
    return assemble(scene), x


def mobility(place, system, x):
    """M from the reference; near a wall the package's own, which has tests of its own."""
    return system.mobility.matrix(x) if place == "near a wall" else reference.rpy(x, overlap=True)


def divergence(matrix_at, x, h=1e-5):
    """``∇·M``: ``Σ_k ∂M_ik/∂x_k`` by central differences, their error about h² and 1e-16/h."""
    total = np.zeros(x.size)
    for k in range(x.size):
        shift = np.zeros(x.size)
        shift[k] = h
        shift = shift.reshape(x.shape)
        total += (matrix_at(x + shift)[:, k] - matrix_at(x - shift)[:, k]) / (2 * h)
    return total


def drift_parts(system, x, temperature, n, seed):
    """Displacements over Δt, taken apart: (deterministic, linear noise, what is left).

    The same random numbers at 1e-8 of the temperature give the linear answer to the noise alone;
    what is left of a displacement without it has the mean ``kT ∇·M`` and little scatter.
    """
    cold = 1e-8
    moves = displacements(system, x, temperature, n, seed) / SHORT
    cold_moves = displacements(system, x, cold * temperature, n, seed) / SHORT
    still = displacements(system, x, 1e-30 * temperature, 1, seed)[0] / SHORT
    linear = (cold_moves - still) / cold**0.5
    return still, linear, moves - still - linear


@each_place
def test_displacements_over_a_step_have_the_covariance_of_the_mobility(place):
    """Fluctuation–dissipation: the covariance over a short step is 2 kT M Δt, with M of the reference.

    6000 draws: every entry within 5 of its standard errors ``√((M_ii M_jj + M_ij²)/n)`` (1.8 % on the
    diagonal), and the mean square in the metric of M within 4 of its own, ``√(2/(n N d))``, 0.5 %.
    """
    n, temperature = 6000, 0.7
    system, x = bent_chain_in(place)
    moves = displacements(system, x, temperature, n, seed=11)
    moves = moves / np.sqrt(2 * temperature * SHORT)
    m = mobility(place, system, x)
    moves -= moves.mean(0)
    covariance = moves.T @ moves / (n - 1)
    error = np.sqrt((np.outer(np.diag(m), np.diag(m)) + m * m) / n)
    assert np.abs((covariance - m) / error).max() < 5
    white = np.linalg.solve(np.linalg.cholesky(m), moves.T)
    assert abs((white**2).mean() - 1) < 4 * np.sqrt(2 / white.size)


@each_place
def test_mean_displacement_is_force_and_drift(place):
    """``M F + kT ∇·M`` with M and F of the reference and ∇·M by numerical differentiation.

    The deterministic part to 1e-3 of the largest velocity (ℰ Δt = 2e-4); the noise's linear part has
    zero mean within 5 standard errors; what is left is the drift within 5, from 2500 draws, and where
    the drift is not zero it is more than 10 of them away from zero.
    """
    temperature = 0.7
    system, x = bent_chain_in(place)
    still, linear, left = drift_parts(system, x, temperature, 2500, seed=12)
    force = -reference.gradient(lambda p: reference.total_energy(p, MODULUS), x)
    velocity = mobility(place, system, x) @ force.ravel()
    assert np.abs(still - velocity).max() < 1e-3 * np.abs(velocity).max()
    assert deviation(sample_average(linear), 0.0) < 5
    drift = temperature * divergence(lambda p: mobility(place, system, p), x)
    assert deviation(sample_average(left), drift) < 5
    if place == "volume":
        assert np.abs(drift).max() < 1e-8
    else:
        assert deviation(sample_average(left), 0.0) > 10


def test_a_bead_near_a_wall_drifts_away_from_it():
    """``kT dM/dh`` along the normal with ``M = 1 − 9/(8h) + 1/(2h³) − 1/(8h⁵)`` (Swan & Brady 2007), 0 along the wall.

    At h = 1.3, where dM/dh is 0.270: 3000 draws, standard error 2.6 %, tolerance 4 of them.
    """
    h, temperature = 1.3, 0.7
    wall = {"point": (0.0, -60.0, 0.0)}
    system = assemble(chain_scene(1, space="volume", wall=wall, temperature=temperature))
    *_, left = drift_parts(system, np.array([[0.3, h - 60.0, -0.2]]), temperature, 3000, seed=13)
    mean, error = sample_average(left)
    expected = temperature * (9 / (8 * h**2) - 3 / (2 * h**4) + 5 / (8 * h**6))
    assert error[1] < 0.035 * expected
    assert abs(mean[1] - expected) < 4 * error[1]
    assert np.abs(mean[[0, 2]] / error[[0, 2]]).max() < 4


@pytest.mark.parametrize("form", ["RPY", "RPY-overlap"])
def test_the_mobility_of_unbounded_fluid_has_no_divergence(form):
    """∇·M = 0 in volume for both forms, to the 1e-9 of the differences: the fluid is incompressible.

    In the plane the motion across it is missing from the sum, and bead i drifts by ``Σ_j g(r) r̂_ij``
    with ``g = 3/(4r²) − 3/(2r⁴)``, overlapping ``g = 3/32``, by hand from the two forms.
    """
    x = bent_chain(6, 7, 3, bend=0.8, stretch=0.2)
    assert np.abs(divergence(PairMobility(form, 3).matrix, x)).max() < 1e-9
    x = bent_chain(6, 7, 2, bend=0.8, stretch=0.2)
    apart = x[:, None] - x[None]
    r = np.linalg.norm(apart, axis=2) + np.eye(len(x))
    g = 3 / (4 * r**2) - 3 / (2 * r**4)
    if form == "RPY-overlap":
        assert (r < 2).sum() > len(x)  # some beads do overlap
        g = np.where(r < 2, 3 / 32, g)
    expected = (g[..., None] * apart / r[..., None]).sum(1).ravel()
    assert np.abs(divergence(PairMobility(form, 2).matrix, x) - expected).max() < 1e-9
    assert np.abs(expected).max() > 0.01
