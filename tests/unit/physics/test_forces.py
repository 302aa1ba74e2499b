"""Stretching, bending and gravity: energies by hand, forces as gradients, symmetries, Jacobians."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import reference
from problems import bent_chain, force_of, jacobian_of, random_rotation, straight_chain, taylor_slope
from sedfiber.physics.bending import Bending
from sedfiber.physics.gravity import Gravity
from sedfiber.physics.stretching import Stretching

MODULUS = 700.0
EFFECTS = {
    "stretching": (Stretching(MODULUS), reference.stretching_energy),
    "bending": (Bending(MODULUS), reference.bending_energy),
    "gravity": (Gravity(), reference.gravity_energy),
}
INTERNAL = ("stretching", "bending")

each_effect = pytest.mark.parametrize("name", EFFECTS)
each_internal = pytest.mark.parametrize("name", INTERNAL)
each_space = pytest.mark.parametrize("dim", [2, 3])
seeds = st.integers(0, 10**6)


@each_space
@each_effect
def test_energy_equals_its_definition(name, dim):
    """The compiled energy equals the sum of DESIGN §1 written out in NumPy."""
    effect, energy = EFFECTS[name]
    x = bent_chain(1, dim=dim)
    assert effect.energy(x) == pytest.approx(energy(x, MODULUS), rel=1e-12)


@each_space
@each_effect
def test_force_is_minus_the_gradient_of_the_energy(name, dim):
    """Against the complex-step gradient of the NumPy energy, which carries no round-off."""
    effect, energy = EFFECTS[name]
    x = bent_chain(2, dim=dim)
    expected = -reference.gradient(lambda p: energy(p, MODULUS), x)
    assert_allclose(force_of(effect, x), expected, rtol=0, atol=1e-12 * MODULUS)


@each_effect
def test_force_is_added_to_what_is_there(name):
    """An effect adds to the array it is given: one shape for every effect (DESIGN §2)."""
    effect, _ = EFFECTS[name]
    x = bent_chain(3)
    force = np.ones_like(x)
    effect.add_force(x, force)
    assert_allclose(force - 1.0, force_of(effect, x), rtol=0, atol=1e-13 * MODULUS)


@each_internal
@given(seed=seeds)
def test_internal_forces_and_torques_sum_to_zero(name, seed):
    """A fiber cannot push or turn itself."""
    effect, _ = EFFECTS[name]
    x = bent_chain(seed)
    force = force_of(effect, x)
    assert_allclose(force.sum(0), 0, atol=1e-11 * MODULUS)
    assert_allclose(np.cross(x, force).sum(0), 0, atol=1e-11 * MODULUS)


@each_space
@each_internal
@given(seed=seeds)
def test_internal_forces_turn_and_move_with_the_fiber(name, dim, seed):
    """For a rotation R and a shift s, F(Rx + s) = R F(x) and the energy stays the same."""
    effect, _ = EFFECTS[name]
    x, turn = bent_chain(seed, dim=dim), random_rotation(seed, dim)
    moved = x @ turn.T + np.random.default_rng(seed).uniform(-5, 5, dim)
    assert_allclose(force_of(effect, moved), force_of(effect, x) @ turn.T, rtol=0, atol=1e-11 * MODULUS)
    assert effect.energy(moved) == pytest.approx(effect.energy(x), rel=1e-10)


@each_internal
@given(seed=seeds)
def test_internal_forces_know_no_first_bead(name, seed):
    """Numbering the beads from the other end reverses the forces and nothing else."""
    effect, _ = EFFECTS[name]
    x = bent_chain(seed)
    assert_allclose(force_of(effect, x[::-1].copy())[::-1], force_of(effect, x), rtol=0, atol=1e-12 * MODULUS)


@each_space
@each_internal
def test_straight_fiber_at_rest_has_no_energy_and_no_force(name, dim):
    """Touching beads in a line are the rest shape of both effects."""
    effect, _ = EFFECTS[name]
    x = straight_chain(31, dim)
    assert effect.energy(x) == 0.0
    assert not force_of(effect, x).any()


def test_right_angle_stores_an_eighth():
    """Two bonds at a right angle: 1 − cos θ = 1, so ℰ/8 of bending and none of stretching."""
    x = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]])
    assert Bending(MODULUS).energy(x) == pytest.approx(MODULUS / 8, rel=1e-15)
    assert Stretching(MODULUS).energy(x) == 0.0


def test_stretched_bond_stores_a_hundredth():
    """One bond of 2.2 a: (2.2/2 − 1)² = 0.01, a tension of 0.1 ℰ, and no bending."""
    x = np.array([[0.0, 0.0], [2.0, 0.0], [4.2, 0.0]])
    assert Stretching(MODULUS).energy(x) == pytest.approx(0.01 * MODULUS, rel=1e-12)
    assert_allclose(force_of(Stretching(MODULUS), x)[2], [-0.1 * MODULUS, 0], rtol=1e-12)
    assert Bending(MODULUS).energy(x) == 0.0


def test_slight_bend_keeps_its_digits():
    """At θ = 1e-6 the energy is ℰ θ²/16 to ten digits, where 1 − cos θ would have four."""
    x = np.array([[-2.0, 0.0], [0.0, 0.0], [2.0 * np.cos(1e-6), 2.0 * np.sin(1e-6)]])
    assert Bending(MODULUS).energy(x) == pytest.approx(MODULUS * 1e-12 / 16, rel=1e-9)


@each_space
def test_gravity_is_one_downward_unit_per_bead(dim):
    """F = −ŷ on each bead, and an energy that falls by one per bead and unit of depth."""
    x = bent_chain(4, dim=dim)
    assert np.array_equal(force_of(Gravity(), x), np.tile([0.0, -1.0, 0.0][:dim], (len(x), 1)))
    lower = x - np.array([0.0, 1.0, 0.0])[:dim]
    assert Gravity().energy(x) - Gravity().energy(lower) == pytest.approx(len(x))


@each_space
@each_internal
def test_force_jacobian_taylor(name, dim):
    """The error of ``F(x + εv) ≈ F(x) + ε J v`` falls as ε² for a true Jacobian (simsopt's test)."""
    effect, _ = EFFECTS[name]
    x = bent_chain(5, dim=dim)
    direction = np.random.default_rng(6).normal(size=x.size)

    def force(y):
        return force_of(effect, y.reshape(x.shape)).ravel()

    slope = taylor_slope(force, jacobian_of(effect, x), x.ravel(), direction, [1e-3, 3e-4, 1e-4, 3e-5])
    assert slope == pytest.approx(2, abs=0.1)


@each_space
@each_effect
def test_force_jacobian_is_symmetric(name, dim):
    """It is minus the second derivative of an energy."""
    effect, _ = EFFECTS[name]
    jac = jacobian_of(effect, bent_chain(7, dim=dim))
    assert_allclose(jac, jac.T, rtol=0, atol=1e-12 * MODULUS)


def test_gravity_has_no_jacobian():
    """A constant force adds nothing."""
    assert not jacobian_of(Gravity(), bent_chain(8)).any()
