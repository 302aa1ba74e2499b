"""Bending about a curved rest shape: forces as gradients, shapes at rest, symmetries, Jacobians."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import reference
from problems import bent_chain, force_of, jacobian_of, random_rotation, straight_chain, taylor_slope
from sedfiber.physics.bending import Bending
from sedfiber.physics.curved_bending import CurvedBending, rest_arc
from sedfiber.physics.stretching import Stretching

MODULUS = 700.0
CURVATURES = [0.1, -0.3]

each_space = pytest.mark.parametrize("dim", [2, 3])
each_curvature = pytest.mark.parametrize("curvature", CURVATURES)
seeds = st.integers(0, 10**6)


def energy(x, curvature):
    """``(ℰ/8) Σ (1 − cos(θ − α))`` of positions (..., N, d), θ signed in the plane and α = |2κ₀| in volume."""
    alpha = 2 * curvature if x.shape[-1] == 2 else abs(2 * curvature)
    t = np.diff(x, axis=-2) / reference.bond_lengths(x)[..., None]
    one, two = t[..., :-1, :], t[..., 1:, :]
    cos, cross = (one * two).sum(-1), one[..., [1, 0]] * two[..., [0, 1]]
    sin = cross[..., 1] - cross[..., 0]
    if x.shape[-1] == 3:
        around = np.cross(one, two)
        sin = np.sqrt((around * around).sum(-1))
    return MODULUS / 8 * (1 - cos * np.cos(alpha) - sin * np.sin(alpha)).sum(-1)


def chain_of(angles):
    """Beads 2a apart in the plane (N, 2) whose bonds turn counterclockwise by ``angles`` (N − 2,)."""
    heading = np.concatenate([[0.3], 0.3 + np.cumsum(angles)])
    return np.vstack([np.zeros(2), np.cumsum(2 * np.column_stack([np.cos(heading), np.sin(heading)]), axis=0)])


def in_volume(x):
    """Positions (N, 2) in the plane z = 0 of space, (N, 3)."""
    return np.column_stack([x, np.zeros(len(x))])


def mirrored(x):
    """Left and right exchanged."""
    return x * np.array([-1.0, 1.0, 1.0])[: x.shape[1]]


@each_space
@each_curvature
def test_energy_equals_its_definition(curvature, dim):
    """The compiled energy against the sum written out in NumPy."""
    x = bent_chain(1, dim=dim)
    assert CurvedBending(MODULUS, curvature).energy(x) == pytest.approx(energy(x, curvature), rel=1e-12)


@each_space
@each_curvature
def test_force_is_minus_the_gradient_of_the_energy(curvature, dim):
    """Against the complex-step gradient of the NumPy energy, which carries no round-off."""
    x = bent_chain(2, dim=dim)
    expected = -reference.gradient(lambda p: energy(p, curvature), x)
    assert_allclose(force_of(CurvedBending(MODULUS, curvature), x), expected, rtol=0, atol=1e-12 * MODULUS)


def test_right_angle_by_hand():
    """Bonds at +90° and α = 30°: 1 − cos 60° = 1/2 in both spaces; at −90° 3/2 in the plane only."""
    left = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]])
    right = left * np.array([1.0, -1.0])
    effect = CurvedBending(8.0, np.pi / 12)
    assert effect.energy(left) == pytest.approx(0.5, rel=1e-14)
    assert effect.energy(right) == pytest.approx(1.5, rel=1e-14)
    assert effect.energy(in_volume(left)) == pytest.approx(0.5, rel=1e-14)
    assert effect.energy(in_volume(right)) == pytest.approx(0.5, rel=1e-14)
    # sin 60° over a bond of 2 on the last bead, which straightens the fiber
    assert_allclose(force_of(effect, left)[2], [np.sqrt(3) / 4, 0], atol=1e-15)


@each_space
def test_energy_keeps_its_digits_near_rest(dim):
    """At θ − α = 1e-6 the energy is ℰ (θ − α)²/16 to nine digits, where 1 − cos would have four."""
    x = np.zeros((3, dim))
    x[0, 0], x[2, :2] = -2.0, 2.0 * np.array([np.cos(0.2 + 1e-6), np.sin(0.2 + 1e-6)])
    assert CurvedBending(MODULUS, 0.1).energy(x) == pytest.approx(MODULUS * 1e-12 / 16, rel=1e-8)


@each_space
@given(seed=seeds)
def test_without_curvature_it_is_bending(dim, seed):
    """Energy, forces and Jacobian of ``Bending`` to round-off, for part of a fiber as well."""
    x = bent_chain(seed, dim=dim)
    for beads in ((), (2, 8)):
        curved, straight = CurvedBending(MODULUS, 0.0, *beads), Bending(MODULUS, *beads)
        assert curved.energy(x) == pytest.approx(straight.energy(x), rel=1e-12)
        assert_allclose(force_of(curved, x), force_of(straight, x), rtol=0, atol=1e-14 * MODULUS)
        assert_allclose(jacobian_of(curved, x), jacobian_of(straight, x), rtol=0, atol=1e-14 * MODULUS)


@each_space
@pytest.mark.parametrize("bend", [0.0, 1e-15, 1e-13, 1e-11, 1e-7])
def test_without_curvature_a_nearly_straight_fiber_is_bending_too(bend, dim):
    """The direction of a bend is lost in round-off there, and nothing depends on it."""
    x = straight_chain(11, dim)
    x[:, 1:] += bend * np.random.default_rng(4).normal(size=(11, dim - 1))
    curved, straight = CurvedBending(MODULUS, 0.0), Bending(MODULUS)
    assert_allclose(force_of(curved, x), force_of(straight, x), rtol=0, atol=1e-15 * MODULUS)
    assert_allclose(jacobian_of(curved, x), jacobian_of(straight, x), rtol=0, atol=1e-13 * MODULUS)


@each_space
@pytest.mark.parametrize("n_beads", [4, 31])
@pytest.mark.parametrize("curvature", [0.0, 0.02, -0.05])
def test_rest_arc_is_at_rest(curvature, n_beads, dim):
    """No energy and no force of bending or stretching; the chord along x, the centre bead at the origin."""
    x = rest_arc(n_beads, curvature, dim)
    assert x.shape == (n_beads, dim) and not x[n_beads // 2].any() and not x[:, 2:].any()
    assert x[-1, 0] > x[0, 0] and x[-1, 1] == pytest.approx(x[0, 1], abs=1e-13)
    for effect in (CurvedBending(MODULUS, curvature), Stretching(MODULUS)):
        assert effect.energy(x) == pytest.approx(0, abs=1e-27 * MODULUS)
        assert_allclose(force_of(effect, x), 0, atol=1e-13 * MODULUS)


@each_curvature
def test_rest_arc_has_its_curvature(curvature):
    """Each bond turns by 2κ₀, counterclockwise for κ₀ > 0: a circle of curvature sin κ₀ that opens upwards."""
    x = rest_arc(11, curvature, 2)
    bonds = np.diff(x, axis=0)
    headings = np.unwrap(np.arctan2(bonds[:, 1], bonds[:, 0]))
    assert_allclose(np.diff(headings), 2 * curvature, rtol=1e-13)
    radius = 1 / np.sin(curvature)
    assert_allclose(np.linalg.norm(x - [0, radius], axis=1), abs(radius), rtol=1e-13)


@given(seed=seeds)
def test_any_shape_with_the_rest_angle_is_at_rest_in_volume(seed):
    """Without resistance to twist each bond may turn about the one before, so arcs are not alone at rest."""
    rng = np.random.default_rng(seed)
    bonds = [np.array([1.0, 0.0, 0.0])]
    for _ in range(9):
        across = np.cross(bonds[-1], rng.normal(size=3))
        bonds.append(np.cos(0.2) * bonds[-1] + np.sin(0.2) * across / np.linalg.norm(across))
    x = np.cumsum(2 * np.array(bonds), axis=0)
    effect = CurvedBending(MODULUS, 0.1)
    assert effect.energy(x) == pytest.approx(0, abs=1e-27 * MODULUS)
    assert_allclose(force_of(effect, x), 0, atol=1e-13 * MODULUS)


def test_straight_fiber_is_bent_in_the_plane_and_on_a_ridge_in_volume():
    """The plane's ends are lifted by (ℰ/8) sin α over a bond; volume has no direction to lift them to."""
    effect, stored = CurvedBending(MODULUS, 0.1), 9 * MODULUS / 8 * (1 - np.cos(0.2))
    flat, spatial = straight_chain(11, 2), straight_chain(11, 3)
    lift = MODULUS / 8 * np.sin(0.2) / 2
    assert_allclose(force_of(effect, flat)[[0, 1, 9, 10], 1], [lift, -lift, -lift, lift], rtol=1e-13)
    assert not force_of(effect, spatial).any()
    assert np.isfinite(jacobian_of(effect, spatial)).all()
    assert effect.energy(flat) == pytest.approx(stored, rel=1e-13)
    assert effect.energy(spatial) == pytest.approx(stored, rel=1e-13)


@pytest.mark.parametrize("bend", [1e-15, 1e-12, 1e-9, 1e-5])
def test_nearly_straight_fiber_pushes_no_harder_in_volume(bend):
    """Up to the ridge the force of an angle stays below (ℰ/8) sin α over a bond, also where it is round-off."""
    x = np.array([[-2.0, 0.0, 0.0], [0.0, 0.0, 0.0], [2.0, bend, 0.3 * bend]])
    force = force_of(CurvedBending(MODULUS, 0.1), x)
    assert np.linalg.norm(force[2]) <= MODULUS / 8 * np.sin(0.2) / 2 * (1 + 1e-3)


@given(seed=seeds)
def test_planar_shape_feels_the_same_in_volume(seed):
    """Where the fiber turns left everywhere, the plane and volume agree, also in the plane's Jacobian."""
    x = chain_of(np.random.default_rng(seed).uniform(0.05, 1.5, 9))
    effect, size = CurvedBending(MODULUS, 0.3), x.size
    assert effect.energy(in_volume(x)) == pytest.approx(effect.energy(x), rel=1e-12, abs=1e-13 * MODULUS)
    assert_allclose(force_of(effect, in_volume(x)), in_volume(force_of(effect, x)), rtol=0, atol=1e-13 * MODULUS)
    jac = jacobian_of(effect, in_volume(x)).reshape(len(x), 3, len(x), 3)
    assert_allclose(jac[:, :2, :, :2].reshape(size, size), jacobian_of(effect, x), rtol=0, atol=1e-12 * MODULUS)
    assert_allclose(jac[:, 2, :, :2], 0, atol=1e-12 * MODULUS)


@each_space
@given(seed=seeds)
def test_forces_and_torques_sum_to_zero(dim, seed):
    """A fiber cannot push or turn itself."""
    x = bent_chain(seed, dim=dim)
    force = force_of(CurvedBending(MODULUS, 0.2), x)
    torque = x[:, :, None] * force[:, None, :]
    assert_allclose(force.sum(0), 0, atol=1e-12 * MODULUS)
    assert_allclose((torque - torque.transpose(0, 2, 1)).sum(0), 0, atol=1e-11 * MODULUS)


@each_space
@each_curvature
@given(seed=seeds)
def test_forces_turn_and_move_with_the_fiber(dim, curvature, seed):
    """For a rotation R and a shift s, F(Rx + s) = R F(x) and the energy stays the same."""
    effect = CurvedBending(MODULUS, curvature)
    x, turn = bent_chain(seed, dim=dim), random_rotation(seed, dim)
    moved = x @ turn.T + np.random.default_rng(seed).uniform(-5, 5, dim)
    assert_allclose(force_of(effect, moved), force_of(effect, x) @ turn.T, rtol=0, atol=1e-11 * MODULUS)
    assert effect.energy(moved) == pytest.approx(effect.energy(x), rel=1e-10)


@each_space
@given(seed=seeds)
def test_numbering_from_the_other_end_turns_the_curvature_over(dim, seed):
    """A left turn is a right turn on the way back, and in a mirror; in volume the sign counts for nothing."""
    effect, other = CurvedBending(MODULUS, 0.2), CurvedBending(MODULUS, -0.2)
    x = bent_chain(seed, dim=dim)
    force, back = force_of(effect, x), x[::-1].copy()
    tolerance = {"rtol": 0, "atol": 1e-12 * MODULUS}
    assert_allclose(force_of(other, back)[::-1], force, **tolerance)
    assert_allclose(mirrored(force_of(other, mirrored(x))), force, **tolerance)
    assert_allclose(mirrored(force_of(effect, mirrored(back)))[::-1], force, **tolerance)
    if dim == 3:
        assert np.array_equal(force_of(other, x), force)
    else:
        assert abs(force_of(other, x) - force).max() > 0.01 * MODULUS


@each_space
def test_part_of_a_chain_is_a_fiber_of_its_own(dim):
    """From ``first`` to before ``last`` the forces are those of these beads alone, added to what is there."""
    x = bent_chain(3, dim=dim)
    expected = np.ones_like(x)
    expected[3:9] += force_of(CurvedBending(MODULUS, 0.2), x[3:9].copy())
    force = np.ones_like(x)
    part = CurvedBending(MODULUS, 0.2, 3, 9)
    part.add_force(x, force)
    assert_allclose(force, expected, rtol=0, atol=1e-14 * MODULUS)
    assert part.energy(x) == CurvedBending(MODULUS, 0.2).energy(x[3:9].copy())


@each_space
@each_curvature
def test_force_jacobian_taylor(curvature, dim):
    """The error of ``F(x + εv) ≈ F(x) + ε J v`` falls as ε² for a true Jacobian, which is symmetric."""
    effect, x = CurvedBending(MODULUS, curvature), bent_chain(5, dim=dim)
    direction = np.random.default_rng(6).normal(size=x.size)
    jac = jacobian_of(effect, x)

    def force(y):
        return force_of(effect, y.reshape(x.shape)).ravel()

    slope = taylor_slope(force, jac, x.ravel(), direction, [1e-3, 3e-4, 1e-4, 3e-5])
    assert slope == pytest.approx(2, abs=0.1)
    assert_allclose(jac, jac.T, rtol=0, atol=1e-12 * MODULUS)
