"""Rotne–Prager–Yamakawa mobility against an outside package, its limits and its symmetries."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from pygrpy.grpy_tensors import muTT

from problems import bent_chain, crumpled_chain, straight_chain, taylor_slope
from reference import rpy
from sedfiber.physics.frame import no_band
from sedfiber.physics.free_draining import FreeDraining
from sedfiber.physics.gaps import smallest_gap
from sedfiber.physics.pair_forms import OSEEN, RPY, RPY_OVERLAP, coefficients
from sedfiber.physics.pair_mobility import PairMobility

FORMS = ("Oseen", "RPY", "RPY-overlap")
PLAIN, OVERLAP = PairMobility("RPY", 3), PairMobility("RPY-overlap", 3)

each_form = pytest.mark.parametrize("form", FORMS)


def velocity_of(mobility, x, force):
    """``M(x) F``, shape (N, d)."""
    u = np.full_like(x, np.nan)
    mobility.velocity(x, force, u)
    return u


def gradient_of(mobility, x, force):
    """``∂(M(x) F)/∂x`` at fixed force, (N d, N d)."""
    jac = np.zeros((x.size, x.size))
    mobility.linearise(x, force, no_band(x.shape), np.empty_like(x), jac)
    return jac


def cloud(seed, n_beads, size, dim=3):
    """Beads thrown into a box, whatever they overlap."""
    return np.random.default_rng(seed).uniform(-size, size, (n_beads, dim))


def pygrpy_mobility(x):
    """pygrpy's translational blocks for unit spheres, in our unit 1/(6πμa) (its μ is 1)."""
    blocks = 6 * np.pi * muTT(x, np.ones(len(x)))
    return blocks.transpose(0, 2, 1, 3).reshape(x.size, x.size)


def distances(x):
    """All pair distances."""
    return np.linalg.norm(x[:, None] - x[None], axis=-1)[np.triu_indices(len(x), 1)]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("size", [1.5, 4.0, 30.0], ids=["overlapping", "mixed", "dilute"])
def test_overlap_form_equals_pygrpy(seed, size):
    """Every entry agrees with pygrpy (Zuk et al. 2014) to 1e-12, overlapping pairs included."""
    x = cloud(seed, 12, size)
    assert_allclose(OVERLAP.matrix(x), pygrpy_mobility(x), rtol=0, atol=1e-12)


def test_clouds_hold_pairs_on_both_sides_of_touching():
    """The comparison above covers overlapping and separate pairs."""
    r = np.concatenate([distances(cloud(seed, 12, 4.0)) for seed in range(5)])
    assert (r < 2).sum() > 10
    assert (r > 2).sum() > 100


@pytest.mark.parametrize("mobility", [PLAIN, OVERLAP], ids=["plain", "overlap"])
def test_touching_pair_equals_pygrpy(mobility):
    """At a distance of exactly 2a both forms meet, and agree with pygrpy."""
    x = np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    assert_allclose(mobility.matrix(x), pygrpy_mobility(x), rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_plain_form_equals_overlap_form_for_separate_beads(seed):
    """Without overlaps the two forms are one, bit for bit."""
    x = 4.2 * np.array(list(np.ndindex(3, 3, 2)), dtype=float) + cloud(seed, 18, 1.0)
    assert distances(x).min() >= 2
    assert np.array_equal(PLAIN.matrix(x), OVERLAP.matrix(x))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("overlap", [False, True])
def test_plain_numpy_reference(seed, overlap):
    """Both forms equal the formula of DESIGN §1 written out in NumPy, overlaps included."""
    x = crumpled_chain(seed)
    assert distances(x).min() < 2
    assert_allclose((OVERLAP if overlap else PLAIN).matrix(x), rpy(x, overlap), rtol=0, atol=1e-13)


@each_form
def test_planar_matrix_is_a_block_of_the_spatial_one(form):
    """For beads in a plane the (x, y) entries in volume are the planar matrix; x–z and y–z vanish."""
    flat = crumpled_chain(3, dim=2)
    spatial = (
        PairMobility(form, 3).matrix(np.column_stack([flat, np.zeros(len(flat))])).reshape(len(flat), 3, len(flat), 3)
    )
    planar = PairMobility(form, 2).matrix(flat).reshape(len(flat), 2, len(flat), 2)
    assert_allclose(planar, spatial[:, :2, :, :2], rtol=0, atol=1e-15)
    assert not spatial[:, 2, :, :2].any()


@pytest.mark.parametrize("dim", [2, 3])
@each_form
def test_velocity_is_matrix_times_force(form, dim):
    """The pair sum that never forms the matrix gives the matrix times the forces."""
    x = crumpled_chain(5, dim=dim)
    force = np.random.default_rng(6).normal(size=x.shape)
    mobility = PairMobility(form, dim)
    assert_allclose(velocity_of(mobility, x, force).ravel(), mobility.matrix(x) @ force.ravel(), rtol=0, atol=1e-13)


@given(seed=st.integers(0, 10**6), size=st.floats(0.5, 6.0))
def test_overlap_form_is_symmetric_positive_definite(seed, size):
    """M = Mᵀ > 0 for any cloud of beads, however much they overlap (Rotne & Prager 1969)."""
    m = OVERLAP.matrix(cloud(seed, 10, size))
    assert np.array_equal(m, m.T)
    assert np.linalg.eigvalsh(m)[0] > 0


@pytest.mark.parametrize(("distance", "positive"), [(2.0, True), (1.14, True), (1.12, False), (0.8, False)])
def test_plain_form_loses_positive_definiteness_for_close_pairs(distance, positive):
    """Two beads pulled apart move against the pull once ``c1 + c2 > 1``, below about 1.13 a."""
    x = np.array([[0.0, 0.0, 0.0], [distance, 0.0, 0.0]])
    assert (np.linalg.eigvalsh(PLAIN.matrix(x))[0] > 0) is np.bool_(positive)
    assert np.linalg.eigvalsh(OVERLAP.matrix(x))[0] > 0


@pytest.mark.parametrize(("axis", "speed"), [(0, 1.625), (1, 1.4375), (2, 1.4375)])
def test_touching_pair_speeds(axis, speed):
    """Two touching beads pushed with one unit each: 13/8 along their line, 23/16 across it."""
    x = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]])
    force = np.zeros((2, 3))
    force[:, axis] = 1.0
    assert_allclose(velocity_of(PLAIN, x, force), speed * force, rtol=1e-15)


@pytest.mark.parametrize(("axis", "speed"), [(0, 5.253489), (1, 3.414123)])
def test_straight_chain_mean_speeds(axis, speed):
    """Mean bead speed of 31 touching beads under one unit of force each, from issue 2 §4."""
    force = np.zeros((31, 3))
    force[:, axis] = 1.0
    assert_allclose(velocity_of(PLAIN, straight_chain(31), force)[:, axis].mean(), speed, atol=5e-7)


@pytest.mark.parametrize("form", [OSEEN, RPY, RPY_OVERLAP])
@pytest.mark.parametrize("r", [0.3, 1.0, 1.7, 2.3, 5.0, 60.0])
def test_derivatives_of_the_pair_coefficients(r, form):
    """``c1'/r`` and ``(c2/r²)'/r`` equal central differences of ``c1`` and ``c2/r²`` on every branch."""
    h = 1e-5 * r
    ahead, behind = (np.array(coefficients((r + s * h) ** 2, form)[:2]) for s in (1, -1))
    assert_allclose(coefficients(r * r, form)[2:], (ahead - behind) / (2 * h * r), rtol=1e-8)


def test_overlap_form_joins_smoothly():
    """Value and slope of both coefficients are continuous at touching (Yamakawa 1970)."""
    assert_allclose(coefficients(4.0 - 1e-13, RPY_OVERLAP), coefficients(4.0, RPY_OVERLAP), rtol=0, atol=1e-12)


@pytest.mark.parametrize("r", [2.0, 3.7, 50.0])
def test_oseen_is_the_far_field(r):
    """``c1 = c2 = 3/(4r)``: a unit force along the line moves another bead by 3/(2r), across it by 3/(4r)."""
    x, force = np.array([[0.0, 0.0], [r, 0.0]]), np.array([[1.0, 1.0], [0.0, 0.0]])
    assert_allclose(velocity_of(PairMobility("Oseen", 2), x, force), [[1, 1], [1.5 / r, 0.75 / r]], rtol=1e-15)


@pytest.mark.parametrize("n_beads", [5, 31])
def test_oseen_fails_for_long_touching_chains(n_beads):
    """A zig-zag of pulls along the chain moves it by 1 − (3/2) ln 2 < 0 when it is long; RPY does not fail there."""
    x = straight_chain(n_beads, 2)
    assert (np.linalg.eigvalsh(PairMobility("Oseen", 2).matrix(x))[0] > 0) is np.bool_(n_beads == 5)
    assert np.linalg.eigvalsh(PairMobility("RPY", 2).matrix(x))[0] > 0.1


@pytest.mark.parametrize("dim", [2, 3])
def test_free_draining_beads_move_alone(dim):
    """Without hydrodynamics velocity is force, and its Jacobian the force's own."""
    x, rng = bent_chain(1, dim=dim), np.random.default_rng(2)
    force, band = rng.normal(size=x.shape), no_band(x.shape)
    assert np.array_equal(velocity_of(FreeDraining(), x, force), force)
    assert np.array_equal(FreeDraining().matrix(x), np.eye(x.size))
    band[3, 0, 1, 4] = 7.0  # force along x on bead 5 by y of bead 4
    jac, u = np.zeros((x.size, x.size)), np.empty_like(x)
    FreeDraining().linearise(x, force, band, u, jac)
    assert jac[5 * dim, 4 * dim + 1] == 7.0 and np.count_nonzero(jac) == 1
    assert np.array_equal(u, force)


@pytest.mark.parametrize("dim", [2, 3])
@each_form
@pytest.mark.parametrize("chain", [bent_chain, crumpled_chain])
def test_mobility_jacobian_taylor(form, dim, chain):
    """At fixed forces the error of ``M(x + εv)F ≈ MF + ε ∂(MF)/∂x v`` falls as ε²."""
    x, rng, mobility = chain(7, dim=dim), np.random.default_rng(8), PairMobility(form, dim)
    force, direction = rng.normal(size=x.shape), rng.normal(size=x.size)

    def velocity(y):
        return velocity_of(mobility, y.reshape(x.shape), force).ravel()

    slope = taylor_slope(velocity, gradient_of(mobility, x, force), x.ravel(), direction, [1e-3, 3e-4, 1e-4, 3e-5])
    assert slope == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("dim", [2, 3])
@each_form
def test_jacobian_adds_the_matrix_times_the_force_jacobian(form, dim):
    """``∂(MF)/∂x = M ∂F/∂x + (∂M/∂x) F`` for a banded ``∂F/∂x``: the two terms separately, and ``u`` in passing."""
    x, rng, mobility = bent_chain(9, dim=dim), np.random.default_rng(10), PairMobility(form, dim)
    force, band = rng.normal(size=x.shape), rng.normal(size=(5, dim, dim, len(x)))
    for offset in range(-2, 3):  # nothing pulls on beads beyond the ends
        for j in range(len(x)):
            if not 0 <= j + offset < len(x):
                band[offset + 2, :, :, j] = 0.0
    both, u, dense = np.zeros((x.size + 1, x.size + 1)), np.empty_like(x), np.zeros((x.size, x.size))
    mobility.linearise(x, force, band, u, both)
    FreeDraining().linearise(x, force, band, np.empty_like(x), dense)
    expected = mobility.matrix(x) @ dense + gradient_of(mobility, x, force)
    assert_allclose(both[:-1, :-1], expected, rtol=0, atol=1e-12)
    assert_allclose(u, velocity_of(mobility, x, force), rtol=0, atol=1e-13)


def test_smallest_gap_leaves_neighbours_out():
    """A hairpin of touching beads: neighbours touch, the two arms are 3a apart, so 1a is free."""
    x = np.array([[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 3.0], [0.0, 3.0]])
    assert smallest_gap(x, 6) == pytest.approx(1.0)


def test_ends_of_two_fibers_are_not_neighbours():
    """Bead 2 and bead 3 are 2.1a apart: neighbours in one fiber of six, not in two of three."""
    x = np.array([[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [6.1, 0.0], [8.1, 0.0], [10.1, 0.0]])
    assert smallest_gap(x, 3) == pytest.approx(0.1)
    assert smallest_gap(x, 6) == pytest.approx(2.0)
