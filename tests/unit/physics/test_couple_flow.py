"""The flow of the beads' couples: rotlets by hand, against pygrpy, far away, symmetries, Jacobians."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pygrpy.grpy_tensors import mu

from problems import bent_chain, crumpled_chain, taylor_slope
from sedfiber.physics.couple_flow import CoupleFlow
from sedfiber.physics.flow_couple import FlowCouple
from sedfiber.physics.linear_flow import LinearFlow, named_gradient
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.parabolic_flow import ParabolicFlow

RATE = 0.3
SHEAR = LinearFlow(named_gradient("shear", RATE))
GENERAL = ((0.2, -0.5, 0.7), (1.1, 0.3, -0.4), (0.6, 0.9, -0.5))  # every entry counts
PEAK, HALF_WIDTH = 1.5, 20.0
FLOWS = {
    "linear": (LinearFlow(GENERAL), lambda y: np.array(GENERAL)),
    "parabolic": (
        ParabolicFlow(PEAK, HALF_WIDTH),
        lambda y: np.array([[0, -2 * PEAK * y / HALF_WIDTH**2, 0], [0, 0, 0], [0, 0, 0]]),
    ),
}
each_space = pytest.mark.parametrize("dim", [2, 3])
each_flow = pytest.mark.parametrize(("flow", "gradient"), FLOWS.values(), ids=FLOWS.keys())


def velocity_of(flow, x, fiber_beads=None):
    """The flow of the couples alone, (N, d); one fiber unless told."""
    u = np.zeros_like(x)
    CoupleFlow(flow, fiber_beads or len(x)).add_velocity(x, u)
    return u


def jacobian_of(flow, x, fiber_beads=None):
    """Its Jacobian alone."""
    jac = np.zeros((x.size, x.size))
    CoupleFlow(flow, fiber_beads or len(x)).add_jacobian(x, jac)
    return jac


def off_the_origin(x):
    """Moved to where no coordinate of the middle is zero."""
    return x + np.array([1.0, 3.0, -2.0])[: x.shape[1]]


def two_fibers(dim):
    """Fibers of six and of six beads, folded so that beads of one and of both overlap, (12, d)."""
    one = crumpled_chain(2, 6, dim)
    return off_the_origin(np.vstack([one, crumpled_chain(3, 6, dim) + 1.5]))


def torques(gradient, x, fiber_beads):
    """Minus each bead's couple (4/3)(ω∞ − Ω), Ω = t × G t, less spin about t; real or complex ``x``, to (N, 3)."""
    n, d = x.shape
    space, out = np.zeros((n, 3), x.dtype), np.zeros((n, 3), x.dtype)
    space[:, :d] = x
    for j in range(n - 1):
        if j // fiber_beads != (j + 1) // fiber_beads:
            continue
        g = gradient(0.5 * (space[j, 1] + space[j + 1, 1])) * np.outer(np.arange(3) < d, np.arange(3) < d)
        b = space[j + 1] - space[j]
        t = b / np.sqrt(b @ b)
        slip = 0.5 * np.array([g[k - 1, k - 2] - g[k - 2, k - 1] for k in range(3)]) - np.cross(t, g @ t)
        couple = 4 / 3 * (slip - (slip @ t) * t)
        out[j] -= couple * (1 if j % fiber_beads == 0 else 0.5)
        out[j + 1] -= couple * (1 if (j + 1) % fiber_beads == fiber_beads - 1 else 0.5)
    return out


def rotlets(gradient, x, fiber_beads):
    """The flow from its definition, pair by pair, (N, d); real or complex ``x``."""
    n, d = x.shape
    torque, out = torques(gradient, x, fiber_beads), np.zeros_like(x)
    for i in range(n):
        for j in range(n):
            r = np.zeros(3, x.dtype)
            r[:d] = x[i] - x[j]
            if i != j:
                dist = np.sqrt(r @ r)
                factor = 3 / 4 / dist**3 if dist.real > 2 else 3 / 8 * (1 - 3 * dist / 8)
                out[i] += (factor * np.cross(torque[j], r))[:d]
    return out


@each_space
@pytest.mark.parametrize(("distance", "factor"), [(2.5, 3 / 4 / 2.5**3), (2.0, 3 / 32), (1.0, 3 / 8 - 9 / 64)])
def test_two_beads_along_a_shear(distance, factor, dim):
    """K = (4/3)(−rate/2) on each; the fluid gets the opposite, which turns the beads the other way about."""
    x = np.zeros((2, dim))
    x[1, 0] = distance
    expected = np.zeros_like(x)
    expected[1, 1] = factor * 2 / 3 * RATE * distance
    expected[0, 1] = -expected[1, 1]
    u = np.ones_like(x)
    CoupleFlow(SHEAR, 2).add_velocity(x, u)
    assert_allclose(u - 1.0, expected, rtol=0, atol=1e-15)


def test_overlap_joins_smoothly():
    """Value and slope agree on both sides of touching, also the derivative by the distance."""
    below, above = (np.array([[0.0, 0.0], [2.0 + h, 0.0]]) for h in (-1e-9, 1e-9))
    assert_allclose(velocity_of(SHEAR, below), velocity_of(SHEAR, above), rtol=0, atol=1e-9)
    assert_allclose(jacobian_of(SHEAR, below), jacobian_of(SHEAR, above), rtol=0, atol=1e-9)


@each_space
@each_flow
def test_velocity_is_the_coupling_of_pygrpy(flow, gradient, dim):
    """Wajnryb et al. (2013): its block of translation by torque, in 1/(6πμa²), overlapping pairs too."""
    x = two_fibers(dim)
    space = np.zeros((len(x), 3))
    space[:, :dim] = x
    dist = np.linalg.norm(space[:, None] - space, axis=-1)[np.triu_indices(len(x), 1)]
    assert ((dist < 2).sum() > 10) & ((dist > 2).sum() > 10) & (dist.min() < 1.5)
    coupling = 6 * np.pi * mu(space, np.ones(len(x)))[: 3 * len(x), 3 * len(x) :]
    expected = (coupling @ torques(gradient, x, 6).ravel()).reshape(-1, 3)
    assert np.abs(expected).max() > 1e-3
    assert_allclose(velocity_of(flow, x, 6), expected[:, :dim], rtol=0, atol=1e-13 * np.abs(expected).max())


@each_space
@each_flow
def test_torques_balance_the_pairs_of_forces(flow, gradient, dim):
    """The moment of ``FlowCouple``'s forces and the beads' torques sum to zero."""
    x = off_the_origin(bent_chain(4, dim=dim))
    force = np.zeros_like(x)
    FlowCouple(flow, len(x)).add_force(x, force)
    space, push = np.zeros((2, len(x), 3))
    space[:, :dim], push[:, :dim] = x, force
    moment = np.cross(space, push).sum(0)
    assert np.abs(moment).max() > 0.01
    assert_allclose(moment, -torques(gradient, x, len(x)).sum(0), rtol=0, atol=1e-13)


@each_space
def test_far_flow_is_radial(dim):
    """No force and no torque in sum leave a stresslet, whose flow has no part across the line of sight."""
    fiber = bent_chain(4, dim=dim)
    away = np.array([3.0, 2.0, 1.0])[:dim] * 1e4
    both = np.vstack([fiber, fiber + away])
    force, pairs = np.zeros_like(both), np.empty_like(both)
    FlowCouple(LinearFlow(GENERAL), len(fiber)).add_force(both[: len(fiber)], force[: len(fiber)])
    PairMobility("RPY", dim).velocity(both, force, pairs)
    rotlet = velocity_of(LinearFlow(GENERAL), both, len(fiber)) - np.vstack(
        2 * [velocity_of(LinearFlow(GENERAL), fiber)]
    )
    sight = away / np.linalg.norm(away)

    def across(u):
        return np.linalg.norm(u - np.outer(u @ sight, sight), axis=1)[len(fiber) :]

    assert across(rotlet).min() > 1e-10
    assert across(pairs + rotlet).max() < 1e-3 * across(rotlet).min()


@each_space
@each_flow
def test_jacobian_is_exact(flow, gradient, dim):
    """The complex step of the definition, for two fibers with overlaps."""
    x, step = two_fibers(dim), 1e-30
    shifts = 1j * step * np.eye(x.size).reshape(x.size, *x.shape)
    expected = np.array([rotlets(gradient, x + s, 6).imag.ravel() / step for s in shifts]).T
    assert_allclose(jacobian_of(flow, x, 6), expected, rtol=0, atol=1e-13 * np.abs(expected).max())


@each_space
@each_flow
def test_jacobian_taylor(flow, gradient, dim):
    """The error of ``u(x + εv) ≈ u(x) + ε J v`` falls as ε²."""
    x = two_fibers(dim)
    direction = np.random.default_rng(6).normal(size=x.size)

    def velocity(y):
        return velocity_of(flow, y.reshape(x.shape), 6).ravel()

    slope = taylor_slope(velocity, jacobian_of(flow, x, 6), x.ravel(), direction, [1e-3, 3e-4, 1e-4, 3e-5])
    assert slope == pytest.approx(2, abs=0.1)


def test_adds_to_a_larger_matrix():
    """What is there stays, and so do the last row and column, which belong to the work."""
    x = off_the_origin(bent_chain(5))
    jac = np.ones((x.size + 1, x.size + 1))
    CoupleFlow(SHEAR, len(x)).add_jacobian(x, jac)
    assert_allclose(jac[:-1, :-1] - 1.0, jacobian_of(SHEAR, x), rtol=0, atol=1e-14)
    assert (jac[-1] == 1.0).all()
    assert (jac[:, -1] == 1.0).all()


@each_flow
def test_plane_equals_volume(flow, gradient):
    """At z = 0, for a gradient that leads nowhere else, velocity and Jacobian agree to the last digits."""
    if isinstance(flow, LinearFlow):
        flow = LinearFlow((*((*row[:2], 0.0) for row in GENERAL[:2]), (0.0, 0.0, 0.0)))
    plane = two_fibers(2)
    volume = np.column_stack([plane, np.zeros(len(plane))])
    full = velocity_of(flow, volume, 6)
    assert_allclose(full[:, :2], velocity_of(flow, plane, 6), rtol=0, atol=1e-14)
    assert not full[:, 2].any()
    blocks = jacobian_of(flow, volume, 6).reshape(len(plane), 3, len(plane), 3)
    assert_allclose(blocks[:, :2, :, :2].reshape(plane.size, -1), jacobian_of(flow, plane, 6), rtol=0, atol=1e-14)
    assert not blocks[:, 2, :, :2].any()


@each_flow
def test_fibers_move_each_other(flow, gradient):
    """Two fibers far apart move as each alone, near each other not; no bond joins them."""
    one, other = off_the_origin(bent_chain(2)), off_the_origin(bent_chain(3))
    n = len(one)
    far = other + np.array([1e5, 0, 1e5])
    alone = np.vstack([velocity_of(flow, one), velocity_of(flow, far)])
    assert_allclose(velocity_of(flow, np.vstack([one, far]), n), alone, rtol=0, atol=1e-9)
    near = np.vstack([one, other + 1.5])
    assert np.abs(velocity_of(flow, near, n)[:n] - alone[:n]).max() > 1e-3
    assert_allclose(velocity_of(flow, near, n), rotlets(gradient, near, n), rtol=0, atol=1e-14)


@each_space
def test_single_beads_make_no_flow(dim):
    x = off_the_origin(bent_chain(2, dim=dim))
    assert not velocity_of(SHEAR, x, 1).any()
    assert not jacobian_of(SHEAR, x, 1).any()


@each_space
def test_rotation_makes_no_flow(dim):
    """A fiber that turns as fast as the fluid puts no torque on it, and neither does a change of its shape."""
    flow, x = LinearFlow(named_gradient("rotation", RATE)), off_the_origin(bent_chain(2, dim=dim))
    assert not velocity_of(flow, x).any()
    assert not jacobian_of(flow, x).any()


def test_only_the_strain_counts():
    """A rigid rotation added to the gradient changes nothing."""
    x = off_the_origin(bent_chain(2))
    turned = np.array(GENERAL) + np.array([[0, -3, 2], [3, 0, -1], [-2, 1, 0]])
    assert_allclose(velocity_of(LinearFlow(turned), x), velocity_of(LinearFlow(GENERAL), x), rtol=0, atol=1e-14)
