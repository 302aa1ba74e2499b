"""The equations of motion: against plain NumPy, their Jacobian, their invariants, their bookkeeping."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import reference
from problems import SCENES, bent_chain, crumpled_chain, straight_chain, system_of, taylor_slope
from sedfiber.physics.free_draining import FreeDraining
from sedfiber.physics.gravity import Gravity
from sedfiber.physics.system import System

MODULUS = 24.0 * 11**3 / 1000.0  # of system_of()

each_scene = pytest.mark.parametrize(("space", "hydrodynamics"), SCENES)
seeds = st.integers(0, 10**6)


def state_at(system, x, place=None):
    """The state of shape ``x`` with its centre bead at ``place``."""
    return system.to_state(x if place is None else x + place)


def bead_velocities(system, x):
    """Velocities in the laboratory frame (N, d), read off the right-hand side."""
    rows = system.rhs(0.0, system.to_state(x))[:-1].reshape(system.shape)
    u = rows + rows[system.centre]
    u[system.centre] = rows[system.centre]
    return u


@pytest.mark.parametrize("space", ["plane", "volume"])
@pytest.mark.parametrize("seed", range(3))
def test_velocities_equal_the_numpy_reference(space, seed):
    """ẋ = M F with forces from complex-step gradients and mobilities written out in NumPy."""
    system = system_of(space)
    x = bent_chain(seed, dim=system.shape[1])
    assert_allclose(bead_velocities(system, x), reference.velocity(x, MODULUS), rtol=0, atol=1e-12 * MODULUS)


@each_scene
@pytest.mark.parametrize("chain", [bent_chain, crumpled_chain])
@pytest.mark.parametrize("seed", range(3))
def test_jacobian_taylor(space, hydrodynamics, chain, seed):
    """The error of ``f(y + εv) ≈ f(y) + ε J v`` falls as ε²: slope 2 ± 0.1, all rows and columns.

    The direction has entries for every bead, for the centre's place and for the work.
    """
    system = system_of(space, hydrodynamics)
    y = system.to_state(chain(seed, dim=system.shape[1]))
    direction = np.random.default_rng(seed + 100).normal(size=y.size)
    slope = taylor_slope(lambda y: system.rhs(0.0, y), system.jacobian(0.0, y), y, direction, [1e-4, 5e-5, 2e-5, 1e-5])
    assert slope == pytest.approx(2, abs=0.1)


@each_scene
@pytest.mark.parametrize("far", [0.0, 1e18], ids=["two beads in one place", "all so far apart that digits are lost"])
def test_beads_in_one_place_give_numbers_that_are_not_finite(space, hydrodynamics, far):
    """And no exception, which would pass through a solver's own code: the solver rejects the step."""
    system = system_of(space, hydrodynamics)
    y = system.to_state(bent_chain(3, dim=system.shape[1]))
    d = system.shape[1]
    y[:d] = y[d : 2 * d]  # beads 0 and 1
    assert not np.isfinite(system.rhs(0.0, y + far)).all()
    assert not np.isfinite(system.jacobian(0.0, y + far)).all()


@each_scene
def test_jacobian_entry_by_entry(space, hydrodynamics):
    """Each column against a central difference, the work's row and column included."""
    system = system_of(space, hydrodynamics)
    y, h = system.to_state(bent_chain(3, dim=system.shape[1])), 1e-6
    columns = [(system.rhs(0.0, y + h * e) - system.rhs(0.0, y - h * e)) / (2 * h) for e in np.eye(y.size)]
    assert_allclose(system.jacobian(0.0, y), np.array(columns).T, rtol=0, atol=1e-7 * MODULUS)


@each_scene
@given(seed=seeds)
def test_rhs_does_not_depend_on_the_place(space, hydrodynamics, seed):
    """Moving the fiber, however far, changes no bit: relative positions are the state."""
    system = system_of(space, hydrodynamics)
    y = system.to_state(bent_chain(seed, dim=system.shape[1]))
    centre = slice(system.centre * system.shape[1], (system.centre + 1) * system.shape[1])
    moved = y.copy()
    moved[centre] += np.random.default_rng(seed).uniform(-1e6, 1e6, system.shape[1])
    assert np.array_equal(system.rhs(0.0, moved), system.rhs(0.0, y))


@each_scene
@given(seed=seeds)
def test_mirror_image_moves_as_the_mirror_image(space, hydrodynamics, seed):
    """x → −x maps the flow onto itself: nothing tells left from right."""
    system = system_of(space, hydrodynamics)
    x, mirror = bent_chain(seed, dim=system.shape[1]), np.array([-1.0, 1.0, 1.0])[: system.shape[1]]
    u = bead_velocities(system, x)
    assert_allclose(bead_velocities(system, mirror * x), mirror * u, rtol=0, atol=1e-12 * MODULUS)


@each_scene
@given(seed=seeds)
def test_reversed_bead_order_moves_in_reversed_order(space, hydrodynamics, seed):
    """Nothing tells the first bead from the last."""
    system = system_of(space, hydrodynamics)
    x = bent_chain(seed, dim=system.shape[1])
    u = bead_velocities(system, x)
    assert_allclose(bead_velocities(system, x[::-1].copy())[::-1], u, rtol=0, atol=1e-12 * MODULUS)


@pytest.mark.parametrize("hydrodynamics", ["RPY", "RPY-overlap"])
@given(seed=seeds, angle=st.floats(-np.pi, np.pi))
def test_turning_about_gravity_turns_the_motion(hydrodynamics, seed, angle):
    """In volume the vertical is the only direction that the fluid and gravity know."""
    system = system_of("volume", hydrodynamics)
    x, c, s = bent_chain(seed), np.cos(angle), np.sin(angle)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    u = bead_velocities(system, x)
    assert_allclose(bead_velocities(system, x @ turn.T), u @ turn.T, rtol=0, atol=1e-12 * MODULUS)


@given(seed=seeds)
def test_flat_fiber_in_volume_moves_as_in_the_plane(seed):
    """z = 0 stays z = 0 exactly, and x and y move as the planar scene says."""
    flat = bent_chain(seed, dim=2)
    spatial = bead_velocities(system_of("volume"), np.column_stack([flat, np.zeros(len(flat))]))
    assert not spatial[:, 2].any()
    assert_allclose(spatial[:, :2], bead_velocities(system_of("plane"), flat), rtol=0, atol=1e-13 * MODULUS)


@each_scene
def test_state_and_positions_are_inverse(space, hydrodynamics):
    """Positions → state → positions returns what went in, padded to three coordinates."""
    system = system_of(space, hydrodynamics)
    x = bent_chain(4, dim=system.shape[1]) + np.arange(1.0, 1.0 + system.shape[1])
    back = system.to_positions(system.to_state(x))
    assert_allclose(back[:, : system.shape[1]], x, rtol=0, atol=1e-14)
    assert not back[:, system.shape[1] :].any()
    shape = system.to_shapes(system.to_state(x))
    assert_allclose(shape, back - back[system.centre], rtol=0, atol=1e-14)


def test_states_of_a_whole_run_convert_at_once():
    """A history (T, N d + 1) gives positions (T, N, 3), sample by sample."""
    system = system_of("plane")
    shapes = [bent_chain(seed, dim=2) + np.array([seed, -seed]) for seed in range(4)]
    states = np.array([system.to_state(x) for x in shapes])
    assert_allclose(system.to_positions(states)[..., :2], shapes, rtol=0, atol=1e-14)


def test_only_listed_effects_act():
    """Without elasticity a bent chain feels its weight alone (DESIGN §2)."""
    listed = System([Gravity()], FreeDraining(), 11, 2)
    x = bent_chain(5, dim=2)
    assert np.array_equal(listed.force(x), np.tile([0.0, -1.0], (11, 1)))
    assert not listed.velocity_jacobian(x).any()
    assert listed.energy(x) == pytest.approx(x[:, 1].sum())


def test_last_entry_of_the_state_is_the_work():
    """Ẇ = Fᵀ M F, from the NumPy reference; no work is done before the start."""
    system = system_of("volume")
    x = bent_chain(6)
    force = -reference.gradient(lambda p: reference.total_energy(p, MODULUS), x).ravel()
    y = system.to_state(x)
    assert y[-1] == 0.0
    assert system.rhs(0.0, y)[-1] == pytest.approx(force @ reference.rpy(x) @ force, rel=1e-11)


def test_counters_count_calls():
    """One count per right-hand side and per Jacobian: these numbers go into the file."""
    system = system_of("plane")
    y = state_at(system, straight_chain(11, 2))
    for _ in range(3):
        system.rhs(0.0, y)
    system.jacobian(0.0, y)
    assert (system.rhs_count, system.jacobian_count) == (3, 1)
