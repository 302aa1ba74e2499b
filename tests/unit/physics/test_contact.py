"""Contact between beads and with a wall: forces as gradients, values by hand, who touches whom, Jacobians."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import reference
from problems import crumpled_chain, force_of, jacobian_of, random_rotation, straight_chain, taylor_slope
from sedfiber.physics.contact import Contact
from sedfiber.physics.frame import no_band
from sedfiber.physics.wall_contact import WallContact

STRENGTH, REACH, N = 3.0, 2.6, 12
FIBERS = [12, 6, 4, 1]  # beads of a fiber: one, two, three fibers, and loose beads
POINT, NORMAL = (1.0, -2.0, 0.5), (0.36, -0.48, 0.8)
WALL = WallContact(STRENGTH, REACH, POINT, NORMAL)

each_space = pytest.mark.parametrize("dim", [2, 3])
each_fiber = pytest.mark.parametrize("fiber_beads", FIBERS)
seeds = st.integers(0, 10**6)


def contact_energy(x, fiber_beads):
    """``Σ S (R² − r²)⁵/(20 (R² − 4)⁴)`` over the pairs in reach, of positions (..., N, d)."""
    i, j = np.triu_indices(x.shape[-2], 1)
    apart = (j - i > 1) | (i // fiber_beads != j // fiber_beads)
    bond = x[..., i[apart], :] - x[..., j[apart], :]
    depth = REACH**2 - (bond * bond).sum(-1)
    return (STRENGTH * np.where(depth.real > 0, depth, 0) ** 5 / (20 * (REACH**2 - 4) ** 4)).sum(-1)


def wall_energy(x):
    """Half the energy of each bead (..., N, 3) and its mirror bead, as of two loose beads."""
    mirrored = x - 2 * ((x - np.array(POINT)) @ np.array(NORMAL))[..., None] * np.array(NORMAL)
    pairs = np.stack([x, mirrored], axis=-2)  # (..., N, 2, 3)
    return sum(contact_energy(pairs[..., i, :, :], 1) for i in range(x.shape[-2])) / 2


def at_wall(seed):
    """Beads (N, 3) at heights from 0.6 to 1.6 over the wall, and anywhere along it."""
    rng = np.random.default_rng(seed)
    x = rng.uniform(-5, 5, (N, 3))
    return x + (rng.uniform(0.6, 1.6, N) - (x - np.array(POINT)) @ np.array(NORMAL))[:, None] * np.array(NORMAL)


def pair(distance, dim=3):
    """Two loose beads."""
    x = np.zeros((2, dim))
    x[1, 0] = distance
    return x


def over_wall(height):
    """One bead over the wall."""
    return np.array([POINT]) + height * np.array([NORMAL])


@each_space
@each_fiber
def test_contact_energy_equals_its_definition(fiber_beads, dim):
    """The compiled sum against NumPy's over all pairs, which is not zero on a crumpled chain."""
    x = crumpled_chain(1, N, dim)
    expected = contact_energy(x, fiber_beads)
    assert expected > STRENGTH
    assert Contact(STRENGTH, REACH, fiber_beads).energy(x) == pytest.approx(expected, rel=1e-12)


@each_space
@each_fiber
def test_contact_force_is_minus_the_gradient_of_the_energy(fiber_beads, dim):
    """Against the complex-step gradient of the NumPy energy."""
    x = crumpled_chain(2, N, dim)
    expected = -reference.gradient(lambda p: contact_energy(p, fiber_beads), x)
    force = force_of(Contact(STRENGTH, REACH, fiber_beads), x)
    assert_allclose(force, expected, rtol=1e-12, atol=1e-12 * abs(expected).max())


def test_wall_energy_and_force_are_those_of_the_mirror_beads():
    """Half the energy of the pairs of bead and mirror bead, and its complex-step gradient."""
    x = at_wall(3)
    assert WALL.energy(x) == pytest.approx(wall_energy(x), rel=1e-12)
    expected = -reference.gradient(wall_energy, x)
    assert_allclose(force_of(WALL, x), expected, rtol=1e-12, atol=1e-12 * abs(expected).max())


@each_space
def test_force_between_touching_beads_is_the_strength(dim):
    """At r = 2 the beads push each other apart with S, and store S (R² − 4)/20."""
    effect = Contact(STRENGTH, REACH, 1)
    along = np.eye(dim)[0]
    assert_allclose(force_of(effect, pair(2.0, dim)), STRENGTH * np.array([-along, along]), rtol=1e-15)
    assert effect.energy(pair(2.0)) == pytest.approx(STRENGTH * (REACH**2 - 4) / 20, rel=1e-15)


def test_force_of_a_touched_wall_is_the_strength():
    """At h = 1 a bead is pushed along the normal with S, and stores S (H² − 1)/10."""
    assert_allclose(force_of(WALL, over_wall(1.0)), [STRENGTH * np.array(NORMAL)], rtol=1e-13)
    assert WALL.energy(over_wall(1.0)) == pytest.approx(STRENGTH * (REACH**2 / 4 - 1) / 10, rel=1e-13)


def test_values_by_hand_halfway():
    """R = 3 and r² = 6.5, so (R² − r²)/(R² − 4) = 1/2: F = (S/2) r/16 and U = S 2.5/(20·16)."""
    effect, x = Contact(8.0, 3.0, 1), pair(np.sqrt(6.5))
    assert_allclose(force_of(effect, x)[1], [np.sqrt(6.5) / 4, 0, 0], rtol=1e-14)
    assert effect.energy(x) == pytest.approx(8 * 2.5 / 320, rel=1e-14)
    wall = WallContact(8.0, 3.0, (0, 0.0, 0), (0.0, 0, 1))  # h = r/2: the same force, half the energy
    x = np.array([[4.0, -3.0, np.sqrt(6.5) / 2]])
    assert_allclose(force_of(wall, x), [[0, 0, np.sqrt(6.5) / 4]], rtol=1e-14)
    assert wall.energy(x) == pytest.approx(8 * 2.5 / 640, rel=1e-14)


@pytest.mark.parametrize("gap", [0.0, 1e-9, 5.0])
def test_beads_out_of_reach_change_no_bit(gap):
    """From R and H on there is no energy, and an array of forces keeps even its negative zeros."""
    loose, high = pair(REACH + gap), over_wall(REACH / 2 + max(gap, 1e-12))
    for effect, x in ((Contact(STRENGTH, REACH, 1), loose), (WALL, high)):
        before = np.full_like(x, -0.0)
        force, jac = before.copy(), no_band(x.shape) if effect.banded else np.full((6, 6), -0.0)
        untouched = jac.copy()
        effect.add_force(x, force)
        effect.add_jacobian(x, jac)
        assert force.tobytes() == before.tobytes() and jac.tobytes() == untouched.tobytes()
        assert effect.energy(x) == 0.0


@pytest.mark.parametrize(("effect", "beads"), [(Contact(STRENGTH, REACH, 1), pair), (WALL, over_wall)])
def test_contact_begins_smoothly(effect, beads):
    """Just inside the reach the force grows as the fourth power of the depth, the energy as the fifth."""
    start = REACH if effect.banded is False else REACH / 2
    depths = np.array([1e-2, 1e-3, 1e-4])
    forces = [np.linalg.norm(force_of(effect, beads(start - e))[-1]) for e in depths]
    energies = [effect.energy(beads(start - e)) for e in depths]
    assert np.polyfit(np.log(depths), np.log(forces), 1)[0] == pytest.approx(4, abs=0.05)
    assert np.polyfit(np.log(depths), np.log(energies), 1)[0] == pytest.approx(5, abs=0.05)


@each_space
def test_neighbours_along_a_fiber_do_not_touch(dim):
    """A straight fiber of touching beads is free of contact; cut in two, its new ends repel."""
    x = straight_chain(N, dim)
    assert not force_of(Contact(STRENGTH, REACH, N), x).any()
    cut = force_of(Contact(STRENGTH, REACH, N // 2), x)
    assert_allclose(cut[N // 2 - 1 : N // 2 + 1, 0], [-STRENGTH, STRENGTH], rtol=1e-14)
    assert np.count_nonzero(cut) == 2


def test_beads_two_apart_along_a_fiber_touch():
    """Three beads folded to an equilateral triangle: only the ends repel, with S at r = 2."""
    x = np.array([[-1.0, 0.0], [0.0, np.sqrt(3)], [1.0, 0.0]])
    assert_allclose(force_of(Contact(STRENGTH, REACH, 3), x), [[-STRENGTH, 0], [0, 0], [STRENGTH, 0]], rtol=1e-14)


def test_beads_on_top_of_each_other_feel_nothing():
    """No direction is preferred at r = 0, and nothing is divided by it."""
    effect = Contact(STRENGTH, REACH, 1)
    assert not force_of(effect, pair(0.0)).any()
    assert np.isfinite(jacobian_of(effect, pair(0.0))).all()


@each_fiber
@given(seed=seeds)
def test_contact_forces_and_torques_sum_to_zero(fiber_beads, seed):
    """Beads in contact cannot push or turn themselves."""
    x = crumpled_chain(seed, N)
    force = force_of(Contact(STRENGTH, REACH, fiber_beads), x)
    scale = 1.0 + abs(force).max()
    assert_allclose(force.sum(0), 0, atol=1e-13 * scale)
    assert_allclose(np.cross(x, force).sum(0), 0, atol=1e-12 * scale)


@each_space
@given(seed=seeds)
def test_contact_turns_and_moves_with_the_beads_and_knows_no_first_one(dim, seed):
    """F(Rx + s) = R F(x), the same energy, and the same from the last bead of the last fiber."""
    effect = Contact(STRENGTH, REACH, 4)
    x, turn = crumpled_chain(seed, N, dim), random_rotation(seed, dim)
    force = force_of(effect, x)
    moved = x @ turn.T + np.random.default_rng(seed).uniform(-5, 5, dim)
    tolerance = 1e-11 * (1.0 + abs(force).max())
    assert_allclose(force_of(effect, moved), force @ turn.T, rtol=0, atol=tolerance)
    assert_allclose(force_of(effect, x[::-1].copy())[::-1], force, rtol=0, atol=tolerance)
    assert effect.energy(moved) == pytest.approx(effect.energy(x), rel=1e-10)


@given(seed=seeds)
def test_wall_contact_knows_heights_alone(seed):
    """Beads slid along the wall, or numbered otherwise, keep their forces, all along the normal."""
    x = at_wall(seed)
    slide = np.random.default_rng(seed).uniform(-5, 5, (N, 3))
    slide -= (slide @ np.array(NORMAL))[:, None] * np.array(NORMAL)
    force = force_of(WALL, x)
    tolerance = 1e-11 * (1.0 + abs(force).max())
    assert_allclose(force_of(WALL, x + slide), force, rtol=0, atol=tolerance)
    assert np.array_equal(force_of(WALL, x[::-1].copy())[::-1], force)
    assert_allclose(np.cross(force, NORMAL), 0, atol=tolerance)
    assert ((force @ np.array(NORMAL)) >= 0).all()


PLACES = [(Contact(STRENGTH, REACH, 4), crumpled_chain(5, N, 2)), (Contact(STRENGTH, REACH, N), crumpled_chain(5, N))]
PLACES.append((WALL, at_wall(5)))


@pytest.mark.parametrize(("effect", "x"), PLACES, ids=["plane", "volume", "wall"])
def test_contact_adds_to_what_is_there(effect, x):
    """A force is added to the array it is given."""
    force = np.ones_like(x)
    effect.add_force(x, force)
    assert_allclose(force - 1.0, force_of(effect, x), rtol=0, atol=1e-13 * abs(force).max())


@pytest.mark.parametrize(("effect", "x"), PLACES, ids=["plane", "volume", "wall"])
def test_contact_jacobian_taylor(effect, x):
    """The error of ``F(x + εv) ≈ F(x) + ε J v`` falls as ε², and J is symmetric."""
    jac = jacobian_of(effect, x)
    direction = np.random.default_rng(6).normal(size=x.size)

    def force(y):
        return force_of(effect, y.reshape(x.shape)).ravel()

    slope = taylor_slope(force, jac, x.ravel(), direction, [1e-3, 3e-4, 1e-4, 3e-5])
    assert slope == pytest.approx(2, abs=0.1)
    assert_allclose(jac, jac.T, rtol=0, atol=1e-13 * abs(jac).max())
