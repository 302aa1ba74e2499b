"""Thermal noise over long runs: fluctuation–dissipation and Boltzmann's distribution.

Expected numbers are closed forms and quadratures of Boltzmann factors.  Every seed is fixed, so a test has
the same outcome in every run; tolerances are in standard errors, which a long run takes from its own block averages.
"""

from itertools import islice

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import i0e, i1e

import reference
from sedfiber import Numerics, simulate
from sedfiber.scene.assembly import assemble
from thermal import DIMS, MODULUS, LinearMotion, block_average, chain_scene, deviation, each_space, integrator_of


@each_space
def test_a_free_bead_diffuses(space):
    """``⟨Δx²⟩ = 2 d kT t`` (Einstein) and Gaussian: ⟨Δx⁴⟩ = 3 ⟨Δx²⟩².

    Over t = 1, 10 and 50 in a run of 5000, disjoint intervals: relative standard errors of n d
    normal numbers, ``√(2/nd)`` from 1.2 % to 10 %, and ``√(96/nd)``; tolerance 4 of them.
    """
    temperature, dim = 0.5, DIMS[space]
    scene = chain_scene(1, space=space, hydrodynamics="none", noise={"peclet": 1 / temperature, "step": 0.5})
    run = simulate(scene, Numerics(interval=0.5), t_end=5000.0)
    assert len(run.t) == 10001
    for t in (1, 10, 50):
        moves = np.diff(run.positions[:: 2 * t, 0, :dim], axis=0).ravel() / np.sqrt(2 * temperature * t)
        assert abs((moves**2).mean() - 1) < 4 * np.sqrt(2 / moves.size)
        assert abs((moves**4).mean() - 3) < 4 * np.sqrt(96 / moves.size)


def test_heights_above_a_wall_are_boltzmanns():
    """Heavy beads above a wall with contact: heights have the density ``exp(−U/kT)``, by quadrature.

    ``U = G h + S (H² − h²)⁵/(10 (H² − 1)⁴)``, the integral of weight and contact force.  Fifteen beads
    1000 a apart do as fifteen runs of one, and start at their quantiles.  Mean height is within 4 standard
    errors, of about 0.005 a, and the occupation of four equally probable layers within 5, of about 2 %
    of a layer; the step's own error, first order, is about one of them.  Without the drift the density
    would be ``exp(−U/kT)/M_zz``: the mean is more than 6 errors away from that one's.
    """
    n, weight, strength, top = 15, 4.0, 20.0, 2.0
    h = np.linspace(0.8, 15.0, 20001)  # below it is 1e-5 of the whole
    barrier = np.clip(top**2 - h**2, 0, None) ** 5 / (10 * (top**2 - 1) ** 4)
    density = np.exp(-weight * h - strength * barrier)
    without_drift = density / (1 - 9 / (8 * h) + 1 / (2 * h**3) - 1 / (8 * h**5))
    expected, wrong = ((h * p).sum() / p.sum() for p in (density, without_drift))
    share = np.cumsum(density) / density.sum()

    wall = {"point": (0.0, -60.0, 0.0)}
    contact = {"strength": strength, "reach": 2 * top}
    parts = {"stretching": None, "bending": None, "gravity": {"strength": weight}}
    system = assemble(chain_scene(n, space="volume", wall=wall, contact=contact, **parts))
    start = np.zeros((n, 3))
    start[:, 0] = 1000.0 * np.arange(n)
    start[:, 1] = np.interp((np.random.default_rng(1).permutation(n) + 0.5) / n, share, h) - 60.0
    integrator = integrator_of(system, 1.0, 0.01, seed=21)
    states = np.array(list(islice(integrator.states(system.to_state(start), 0.05), 2800)))
    heights = system.to_positions(states)[..., 1] + 60.0
    mean, error = block_average(heights.mean(1), 40)
    assert abs(mean - expected) < 4 * error
    assert abs(mean - wrong) > 6 * error
    layer = np.searchsorted(np.interp([0.25, 0.5, 0.75], share, h), heights)
    occupied = np.stack([(layer == k).mean(1) for k in range(4)], axis=1)
    assert deviation(block_average(occupied, 40), 0.25) < 5


def bond_energy(dim, modulus):
    """⟨ℰ (r/2 − 1)²⟩ of one bond at kT = 1, weights ``r^(d−1) exp(−U)``: about 1/2."""

    def integral(observed):
        scatter = (2 / modulus) ** 0.5
        low, high = max(0.0, 2 - 12 * scatter), 2 + 12 * scatter
        weight = lambda r: r ** (dim - 1) * np.exp(-modulus * (r / 2 - 1) ** 2) * observed(r)  # noqa: E731
        return quad(weight, low, high, points=[2.0])[0]

    return integral(lambda r: modulus * (r / 2 - 1) ** 2) / integral(lambda r: 1.0)


def mean_cosine(dim, stiffness):
    """⟨cos θ⟩ with the weight ``exp(κ cos θ)`` of a planar angle, and ``sin θ`` times that in volume."""
    return i1e(stiffness) / i0e(stiffness) if dim == 2 else 1 / np.tanh(stiffness) - 1 / stiffness


def measure_fibers(space, hydrodynamics, step, t_end, seed):
    """Ten free fibers of three beads at kT = 1: history of the mean cos θ and of the mean energy of a bond.

    They start 2.5 a apart, so that they overlap and push each other through the fluid; that does
    not change the equilibrium, in which bonds and angles are independent of each other.
    """
    places = [{"place": (0.0, 2.5 * k, 0.0)} for k in range(10)]
    scene = chain_scene(3, space=space, hydrodynamics=hydrodynamics, fibers=places)
    system = assemble(scene)
    integrator = integrator_of(system, 1.0, step, seed)
    interval, settled = step * max(1, round(0.08 / step)), 3.0
    states = integrator.states(system.to_state(scene.start()), interval)
    states = np.array(list(islice(states, round(settled / interval), round((settled + t_end) / interval))))
    bonds = np.diff(system.to_positions(states).reshape(len(states), 10, 3, 3), axis=2)
    r = np.linalg.norm(bonds, axis=3)
    cosine = (bonds[:, :, 0] * bonds[:, :, 1]).sum(-1) / (r[..., 0] * r[..., 1])
    return cosine.mean(1), (MODULUS * (r / 2 - 1) ** 2).mean((1, 2))


@pytest.mark.parametrize("hydrodynamics", ["none", "RPY-overlap"])
@each_space
def test_bonds_and_angles_have_their_thermal_energy(space, hydrodynamics):
    """Equipartition of a phantom chain at κ = ℰ/(8kT) = 3, which hydrodynamics does not change.

    ⟨cos θ⟩, and with it the bending energy κ (1 − ⟨cos θ⟩), is I₁(κ)/I₀(κ) in the plane and coth κ − 1/κ
    in volume; the energy of a bond is that of its quadrature.  Both within 4 standard errors, at most
    8 % and 3 % of these energies; the step's own error, first order, is at most 2 % of the bond's.
    """
    dim, seed = DIMS[space], 31
    angles, bonds = measure_fibers(space, hydrodynamics, 0.01, 100.0, seed)
    cosine, error = block_average(angles, 16)
    assert error < 0.08 * (1 - cosine)
    assert abs(cosine - mean_cosine(dim, MODULUS / 8)) < 4 * error
    energy, error = block_average(bonds, 16)
    assert error < 0.03 * energy
    assert abs(energy - bond_energy(dim, MODULUS)) < 4 * error


def test_error_of_a_mean_falls_with_the_step():
    """Weak order one: the error of the mean bond energy at steps 0.12, 0.06, 0.03 is a power of the step near one.

    Longer runs gave 0.142 ± 0.003, 0.058 ± 0.002 and 0.028 ± 0.002.  With 0.005 here the slope of the
    logarithms is known to ± 0.14, and between 0.7 and 1.8, four times that about their 1.2.
    """
    steps = (0.12, 0.06, 0.03)
    errors = []
    for step in steps:
        energy, error = block_average(measure_fibers("volume", "RPY-overlap", step, 250.0, seed=41)[1])
        errors.append(energy - bond_energy(3, MODULUS))
        assert error < 0.008
    assert 0.7 < np.polyfit(np.log(steps), np.log(errors), 1)[0] < 1.8


@each_space
def test_a_stiff_fiber_keeps_its_energy_at_large_steps(space):
    """At ℰ Δt = 20, twenty times an explicit scheme's limit: kT/2 for each of 4 bonds and of 3 (d − 1) bends.

    ℰ/kT = 1e6, so that the linear theory of the implicit midpoint holds; within 4 standard errors of
    at most 5 % of the exact averages.
    """
    modulus, dim = 1e6, DIMS[space]
    scene = chain_scene(5, modulus, space=space)
    system = assemble(scene)
    integrator = integrator_of(system, 1.0, 20.0 / modulus, seed=51)
    states = np.array(list(islice(integrator.states(system.to_state(scene.start()), 20.0 / modulus), 500, 8500)))
    x = system.to_positions(states)
    stretching, bending = reference.stretching_energy(x, modulus), reference.bending_energy(x, modulus)
    stiffness = modulus / 8
    for measured, exact in (
        (stretching, 4 * bond_energy(dim, modulus)),
        (bending, 3 * stiffness * (1 - mean_cosine(dim, stiffness))),
    ):
        mean, error = block_average(measured)
        assert error < 0.05 * exact
        assert abs(mean - exact) < 4 * error


def test_linear_springs_have_their_equilibrium_at_any_step():
    """Three coupled coordinates with rates 10/Δt, 1/Δt and 0.1/Δt: the covariance is kT K⁻¹ (equipartition).

    All entries within 5 standard errors of block averages, about 4 % on the diagonal.  Along the stiff
    mode an implicit Euler step would keep 2/(2 + 10) of the energy, which is more than 20 errors away.
    """
    temperature, step, rates = 0.3, 0.5, np.array([10.0, 1.0, 0.1])
    rng = np.random.default_rng(3)
    root = rng.normal(size=(3, 3)) + 2 * np.eye(3)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    inverse = np.linalg.inv(root)
    system = LinearMotion(root @ root.T, inverse.T @ turn @ np.diag(rates / step) @ turn.T @ inverse)
    assert np.allclose(np.sort(np.linalg.eigvals(system.m @ system.k).real), np.sort(rates / step))
    states = np.array(list(islice(integrator_of(system, temperature, step, 61).states(np.zeros(3), step), 200, 12200)))
    covariance = block_average(states[:, :, None] * states[:, None, :])
    assert deviation(covariance, temperature * np.linalg.inv(system.k)) < 5
    stiff = (states @ inverse.T @ turn)[:, 0]  # the mode's energy is its rate times its square over two
    energy, error = block_average(rates[0] / step * stiff**2 / 2)
    assert error < 0.03 * temperature / 2
    assert abs(energy - temperature / 2) < 4 * error
    assert abs(energy - temperature / 2 * 2 / (2 + rates[0])) > 20 * error
