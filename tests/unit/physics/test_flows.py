"""Flows and the couple they exert on bonds: velocities and torques by hand, symmetries, Jacobians."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from problems import bent_chain, straight_chain, taylor_slope
from sedfiber.physics.flow_couple import FlowCouple
from sedfiber.physics.frame import no_band
from sedfiber.physics.free_draining import add_band
from sedfiber.physics.linear_flow import NAMED_FLOWS, LinearFlow, named_gradient
from sedfiber.physics.parabolic_flow import ParabolicFlow

RATE = 0.3
GENERAL = ((0.2, -0.5, 0.7), (1.1, 0.3, -0.4), (0.6, 0.9, -0.5))  # every entry counts
BY_HAND = {
    "shear": lambda x, y: (RATE * y, 0.0),
    "extension": lambda x, y: (RATE * x, -RATE * y),
    "rotation": lambda x, y: (-RATE * y, RATE * x),
}
FLOWS = {"linear": LinearFlow(GENERAL), "parabolic": ParabolicFlow(1.5, 20.0)}

each_space = pytest.mark.parametrize("dim", [2, 3])
each_name = pytest.mark.parametrize("name", NAMED_FLOWS)
each_flow = pytest.mark.parametrize("flow", FLOWS.values(), ids=FLOWS.keys())


def velocity_of(flow, x):
    """The velocities of one flow alone, (N, d)."""
    u = np.zeros_like(x)
    flow.add_velocity(x, u)
    return u


def couple_of(flow, x, fiber_beads=None):
    """The forces of the couples alone, (N, d); one fiber unless told."""
    force = np.zeros_like(x)
    FlowCouple(flow, fiber_beads or len(x)).add_force(x, force)
    return force


def chain_off_the_origin(dim, seed=1):
    """A bent chain where no coordinate of the middle is zero."""
    return bent_chain(seed, dim=dim) + np.array([1.0, 3.0, -2.0])[:dim]


@each_space
@each_name
def test_named_flows_by_hand(name, dim):
    """u = rate (y, 0), rate (x, −y) and rate (−y, x), nothing along z, added to what is there."""
    x = chain_off_the_origin(dim)
    expected = np.zeros_like(x)
    expected[:, 0], expected[:, 1] = BY_HAND[name](x[:, 0], x[:, 1])
    u = np.ones_like(x)
    LinearFlow(named_gradient(name, RATE)).add_velocity(x, u)
    assert_allclose(u - 1.0, expected, rtol=0, atol=1e-14)


@each_name
def test_named_flows_keep_volumes(name):
    """The trace of the gradient is the rate at which volumes grow."""
    assert np.trace(named_gradient(name, RATE)) == 0.0


@each_space
@each_flow
def test_flow_jacobian(flow, dim):
    """A central difference, exact for these flows; added to a matrix with a row and column to spare."""
    x, step = chain_off_the_origin(dim), 0.5
    jac = np.ones((x.size + 1, x.size + 1))
    flow.add_jacobian(x, jac)
    shifts = step * np.eye(x.size).reshape(x.size, *x.shape)
    difference = [(velocity_of(flow, x + s) - velocity_of(flow, x - s)).ravel() / (2 * step) for s in shifts]
    assert_allclose(jac[:-1, :-1] - 1.0, np.transpose(difference), rtol=0, atol=1e-13)
    assert (jac[-1] == 1.0).all()
    assert (jac[:, -1] == 1.0).all()


@each_space
def test_rotation_is_rigid(dim):
    """No bond grows, and no couple acts: the fiber turns as fast as the fluid."""
    flow, x = LinearFlow(named_gradient("rotation", RATE)), chain_off_the_origin(dim)
    growth = (np.diff(velocity_of(flow, x), axis=0) * np.diff(x, axis=0)).sum(1)
    assert_allclose(growth, 0, atol=1e-14)
    assert not couple_of(flow, x).any()


def test_parabolic_flow_carries_a_bead_at_its_surface_mean():
    """Faxén: the mean of P (1 − y²/H²) over the unit sphere about a bead, by a rule exact for its degree."""
    flow, x = FLOWS["parabolic"], chain_off_the_origin(3)
    axes = np.vstack([np.eye(3), -np.eye(3)])  # the mean over these six is exact to degree 3
    y = (x[:, None] + axes)[..., 1]
    expected = (flow.peak * (1 - y**2 / flow.half_width**2)).mean(1)
    u = velocity_of(flow, x)
    assert_allclose(u[:, 0], expected, rtol=1e-14)
    assert not u[:, 1:].any()


@each_flow
def test_strain_is_the_symmetric_part_of_the_gradient(flow):
    """``E0 + s y`` against the Jacobian of one bead."""
    x = np.array([[0.5, -2.0, 0.8]])
    jac = np.zeros((3, 3))
    flow.add_jacobian(x, jac)
    strain, slope = flow.strain
    shear = np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
    assert_allclose(strain + slope * x[0, 1] * shear, 0.5 * (jac + jac.T), rtol=0, atol=1e-15)


@each_space
@each_flow
def test_couple_is_the_sum_over_beads_of_its_definition(flow, dim):
    """Pairs of forces from cross products: each bead's (4/3)(ω∞ − Ω) on its bonds, f = K × t/|b|."""
    x = chain_off_the_origin(dim)
    space = np.zeros((len(x), 3))
    space[:, :dim] = x
    expected, n = np.zeros_like(space), len(x)
    for j in range(n - 1):
        middle, b = 0.5 * (space[j] + space[j + 1]), space[j + 1] - space[j]
        gradient = np.zeros((3, 3))
        flow.add_jacobian(middle[None], gradient)
        if dim == 2:
            gradient[2], gradient[:, 2] = 0.0, 0.0
        length = np.linalg.norm(b)
        t = b / length
        vorticity = np.array([gradient[k - 1, k - 2] - gradient[k - 2, k - 1] for k in range(3)])
        slip = 0.5 * vorticity - np.cross(t, gradient @ t)
        weight = 0.5 * (1 + (j == 0)) + 0.5 * (1 + (j == n - 2))
        pair = weight * 4 / 3 * np.cross(slip, t) / length
        expected[j + 1] += pair
        expected[j] -= pair
    assert_allclose(couple_of(flow, x), expected[:, :dim], rtol=0, atol=1e-14)


@pytest.mark.parametrize("n_beads", [2, 3, 31])
def test_torque_on_a_chain_along_a_shear(n_beads):
    """(4/3)(−rate/2) for each bead, whatever the number of bonds, and no net force."""
    x = straight_chain(n_beads)
    force = couple_of(LinearFlow(named_gradient("shear", RATE)), x)
    assert_allclose(np.cross(x, force).sum(0), [0, 0, -2 / 3 * RATE * n_beads], rtol=1e-13)
    assert_allclose(force.sum(0), 0, atol=1e-15)


@each_space
@each_flow
def test_couples_only_turn(flow, dim):
    """The pair on a bond sums to zero and stands across it: a fiber of two beads, many directions."""
    for seed in range(20):
        x = chain_off_the_origin(dim, seed)[:2].copy()
        behind, ahead = couple_of(flow, x)
        assert_allclose(ahead, -behind, rtol=0, atol=1e-15)
        assert abs(ahead @ (x[1] - x[0])) < 1e-14


@each_space
def test_couples_know_no_turning_frame(dim):
    """A rigid rotation added to the gradient changes no couple."""
    x = chain_off_the_origin(dim)
    turned = np.array(GENERAL) + np.array([[0, -3, 2], [3, 0, -1], [-2, 1, 0]])
    assert_allclose(couple_of(LinearFlow(turned.tolist()), x), couple_of(FLOWS["linear"], x), rtol=0, atol=1e-14)


@each_space
@each_flow
def test_couple_jacobian_taylor(flow, dim):
    """The error of ``F(x + εv) ≈ F(x) + ε J v`` falls as ε²; fibers of six and five beads."""
    x = chain_off_the_origin(dim, 5)
    band, jac = no_band(x.shape), np.zeros((x.size, x.size))
    FlowCouple(flow, 6).add_jacobian(x, band)
    add_band(band, jac)
    direction = np.random.default_rng(6).normal(size=x.size)

    def force(y):
        return couple_of(flow, y.reshape(x.shape), 6).ravel()

    slope = taylor_slope(force, jac, x.ravel(), direction, [1e-3, 3e-4, 1e-4, 3e-5])
    assert slope == pytest.approx(2, abs=0.1)


@each_flow
def test_plane_equals_volume(flow):
    """At z = 0, and for a gradient that leads nowhere else, both kernels agree to the last digits."""
    if isinstance(flow, LinearFlow):
        flow = LinearFlow((*((*row[:2], 0.0) for row in GENERAL[:2]), (0.0, 0.0, 0.0)))
    plane = chain_off_the_origin(2)
    volume = np.column_stack([plane, np.zeros(len(plane))])
    for part in (velocity_of, couple_of):
        flat, full = part(flow, plane), part(flow, volume)
        assert_allclose(full[:, :2], flat, rtol=0, atol=1e-14)
        assert not full[:, 2].any()


@each_flow
def test_fibers_are_not_bonded(flow):
    """Two fibers numbered one after the other feel what each feels alone; single beads nothing."""
    one, other = chain_off_the_origin(3, 2), chain_off_the_origin(3, 3) + 7.0
    both = couple_of(flow, np.vstack([one, other]), len(one))
    assert_allclose(both, np.vstack([couple_of(flow, one), couple_of(flow, other)]), rtol=0, atol=1e-14)
    assert not couple_of(flow, one, 1).any()
    band = no_band(one.shape)
    FlowCouple(flow, 1).add_jacobian(one, band)
    assert not band.any()
