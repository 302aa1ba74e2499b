"""The wall's correction to the mobility against Blake's tensor, exact drags and its symmetries."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from problems import bent_chain, crumpled_chain, random_rotation, taylor_slope
from reference import STEP, rpy
from sedfiber.physics.wall import WallCorrection

FLOOR = WallCorrection((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
OBLIQUE = WallCorrection((1.0, -2.0, 0.5), (0.36, -0.48, 0.8))


def oseen(r):
    """``I/r + r r/r³`` (..., 3, 3) of separations (..., 3)."""
    dist = np.sqrt((r * r).sum(-1))[..., None, None]
    return np.eye(3) / dist + r[..., :, None] * r[..., None, :] / dist**3


def image_tensor(x, y):
    """What the wall z = 0 adds at ``x`` to the Oseen tensor of a force at ``y``, in 1/(6πμa).

    Blake (1971) as Pozrikidis (1992, §3.3) writes it: an opposite Stokeslet at the image, a
    source doublet D and a Stokeslet doublet SD, whose columns change sign for a normal force.
    """
    r, h = x - y * [1, 1, -1], y[..., 2, None, None]
    dist = np.sqrt((r * r).sum(-1))[..., None, None]
    e = np.array([0.0, 0.0, 1.0])
    sign = np.array([1.0, 1.0, -1.0])
    doublet = sign * (np.eye(3) / dist**3 - 3 * r[..., :, None] * r[..., None, :] / dist**5)
    twist = sign * (r[..., :, None] * e - e[:, None] * r[..., None, :]) / dist**3
    stokes_doublet = r[..., 2, None, None] * doublet + twist
    return 0.75 * (-oseen(r) + 2 * h**2 * doublet - 2 * h * stokes_doublet)


def sphere(order):
    """Points (P, 3) and weights (P,) of a mean over the unit sphere, exact to degree 2·order − 1."""
    z, weight = np.polynomial.legendre.leggauss(order)
    phi = np.pi * np.arange(2 * order) / order
    ring = np.sqrt(1 - z * z)[:, None]
    points = np.stack([ring * np.cos(phi), ring * np.sin(phi), z[:, None] + 0 * phi], axis=-1)
    return points.reshape(-1, 3), np.repeat(weight, 2 * order) / (4 * order)


def averaged_image(xi, xj, order):
    """Mean of the image tensor over the surfaces of both beads: the definition of ``ΔM_ij``."""
    points, weights = sphere(order)
    total = 0.0
    for p, weight in zip(points, weights, strict=True):
        total = total + weight * np.tensordot(weights, image_tensor(xi + points, xj + p), 1)
    return total


def averaged_velocity(x, force, order):
    """``ΔM(x) F`` (N, 3) from the averaged images; complex positions pass through."""
    blocks = np.array([[averaged_image(xi, xj, order) for xj in x] for xi in x])
    return np.einsum("ijkl,jl->ik", blocks, force)


def matrix(wall, x):
    """``ΔM(x)`` (3N, 3N)."""
    m = np.zeros((x.size, x.size))
    wall.add_matrix(x, m)
    return m


def velocity(wall, x, force):
    """``ΔM(x) F`` (N, 3)."""
    u = np.zeros_like(x)
    wall.add_velocity(x, force, u)
    return u


def gradient(wall, x, force):
    """``∂(ΔM(x) F)/∂x`` (3N, 3N)."""
    jac = np.zeros((x.size, x.size))
    wall.add_gradient(x, force, jac)
    return jac


def self_mobility(h):
    """Mobility along and across the wall of one bead at height ``h``, its own 1 included."""
    m = np.eye(3) + matrix(FLOOR, np.array([[0.3, -2.0, h]]))
    return m[0, 0], m[2, 2]


def brenner_drag(h):
    """Brenner's (1961) exact drag, over Stokes', of a sphere that moves across the wall."""
    alpha = np.arccosh(h)
    n = np.arange(1, int(40 / alpha) + 10)
    top = 2 * np.sinh((2 * n + 1) * alpha) + (2 * n + 1) * np.sinh(2 * alpha)
    bottom = 4 * np.sinh((n + 0.5) * alpha) ** 2 - (2 * n + 1) ** 2 * np.sinh(alpha) ** 2
    terms = n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * (top / bottom - 1)
    return 4 / 3 * np.sinh(alpha) * terms.sum()


def cloud(seed, n_beads, size, lowest=1.0):
    """Beads thrown into a box above the floor, whatever they overlap; one of them sits at its bottom."""
    x = np.random.default_rng(seed).uniform(-size, size, (n_beads, 3))
    x[:, 2] += lowest - x[:, 2].min()
    return x


def above(wall, x, lowest=1.5):
    """The shape ``x`` moved along the normal until its lowest bead has that height."""
    return x + (lowest - wall.heights(x).min()) * np.array(wall.normal)


def log_slope(t, values):
    """Slope of ``log values`` against ``log t``."""
    return np.polyfit(np.log(t), np.log(values), 1)[0]


@pytest.mark.parametrize("seed", range(5))
def test_reference_does_not_slip(seed):
    """The reference's Green's function: no flow at the wall, for any force and point."""
    rng = np.random.default_rng(seed)
    y = rng.uniform([-3, -3, 1], [3, 3, 7])
    on_wall = rng.uniform(-10, 10, (20, 3)) * [1, 1, 0]
    assert_allclose(0.75 * oseen(on_wall - y) + image_tensor(on_wall, y), 0, rtol=0, atol=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_reference_is_reciprocal_and_solenoidal(seed):
    """The reference's Green's function: ``G(x, y) = G(y, x)ᵀ`` (Lorentz) and ``∇_x·G = 0``."""
    x, y = np.random.default_rng(seed).uniform(0.5, 4, (2, 3))
    assert_allclose(image_tensor(x, y), image_tensor(y, x).T, rtol=0, atol=1e-14)
    slopes = image_tensor(x + 1j * STEP * np.eye(3), y).imag / STEP
    assert_allclose(np.einsum("kkj->j", slopes), 0, rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    ("separation", "zi", "zj", "order"),
    [
        ((0.0, 0.0), 2.0, 2.0, 14),  # a bead's own image
        ((0.0, 0.0), 1.4, 1.4, 24),
        ((0.0, 0.0), 5.0, 2.5, 12),  # one above the other
        ((2.0, 0.0), 1.6, 1.6, 14),
        ((1.1, -1.7), 3.0, 1.5, 14),
        ((0.4, 0.3), 2.0, 2.3, 14),  # overlapping
        ((0.0, -7.0), 1.01, 4.0, 14),
        ((-30.0, 12.0), 20.0, 1.2, 8),
    ],
)
def test_blocks_equal_surface_averages_of_the_image_tensor(separation, zi, zj, order):
    """Pair and self blocks equal the mean of Blake's tensor over both beads to 1e-13, without Faxén operators."""
    x = np.array([[*separation, zi], [0.0, 0.0, zj]])
    m = matrix(FLOOR, x)
    assert_allclose(m[:3, 3:], averaged_image(x[0], x[1], order), rtol=0, atol=1e-13)
    assert_allclose(m[3:, :3], averaged_image(x[1], x[0], order), rtol=0, atol=1e-13)
    if not any(separation) and zi == zj:
        assert_allclose(m[:3, :3], m[:3, 3:], rtol=0, atol=1e-14)


@pytest.mark.parametrize("h", [1.0, 1.3, 2.0, 5.0, 30.0])
def test_self_mobility_expansion(h):
    """The self block is the diagonal matrix of Swan & Brady's polynomials in 1/h."""
    parallel = -9 / (16 * h) + 1 / (8 * h**3) - 1 / (16 * h**5)
    across = -9 / (8 * h) + 1 / (2 * h**3) - 1 / (8 * h**5)
    m = matrix(FLOOR, np.array([[0.3, -2.0, h]]))
    assert_allclose(m, np.diag([parallel, parallel, across]), rtol=0, atol=1e-14)


def test_brenner_drag_equals_his_table():
    """The exact drag used below, at α = 1 and 2 of Brenner's (1961) table."""
    assert_allclose([brenner_drag(np.cosh(a)) for a in (1, 2)], [3.0361, 1.4129], rtol=0, atol=5e-5)


def test_self_mobility_far_from_the_wall():
    """From Brenner's exact value (across) and Faxén's series (along) it is off by order h⁻⁴, at h = 5 below 1e-3."""
    h = np.array([5.0, 10.0, 20.0, 40.0])
    parallel, across = np.array([self_mobility(value) for value in h]).T
    off_across = across - [1 / brenner_drag(value) for value in h]
    off_parallel = parallel - (1 - 9 / (16 * h) + 1 / (8 * h**3) - 45 / (256 * h**4) - 1 / (16 * h**5))
    assert max(off_across[0], off_parallel[0]) < 1e-3
    assert log_slope(h, off_across) == pytest.approx(-4, abs=0.1)
    assert log_slope(h, off_parallel) == pytest.approx(-4, abs=0.1)


@pytest.mark.parametrize("h", [1.01, 1.1, 1.3, 2.0, 4.0])
def test_self_mobility_bounds_the_exact_one_from_above(h):
    """Force spread evenly over a sphere dissipates more than the rigid sphere; the excess stays below 0.6/h⁴."""
    excess = self_mobility(h)[1] - 1 / brenner_drag(h)
    assert 0 < excess < 0.6 / h**4


@given(seed=st.integers(0, 10**6), size=st.floats(0.5, 20.0))
def test_symmetric(seed, size):
    """ΔM = ΔMᵀ for any cloud of beads, along an axis and for an oblique wall."""
    x = cloud(seed, 8, size)
    assert np.array_equal(matrix(FLOOR, x), matrix(FLOOR, x).T)
    m = matrix(OBLIQUE, above(OBLIQUE, x, 1.0))
    assert_allclose(m, m.T, rtol=0, atol=1e-14)


@given(seed=st.integers(0, 10**6), size=st.floats(0.5, 6.0))
def test_whole_mobility_is_positive_definite(seed, size):
    """RPY with its overlap form plus ΔM is positive definite, however beads overlap, down to the wall's touch."""
    x = cloud(seed, 10, size)
    assert np.linalg.eigvalsh(rpy(x, overlap=True) + matrix(FLOOR, x))[0] > 0


@given(seed=st.integers(0, 10**6), size=st.floats(0.5, 6.0))
def test_wall_slows_every_force_distribution(seed, size):
    """ΔM is negative definite: no-slip only takes away from what a set of forces dissipates freely."""
    assert np.linalg.eigvalsh(matrix(FLOOR, cloud(seed, 10, size)))[-1] < 0


def test_vanishes_like_the_inverse_height():
    """Far away every self and pair block falls as 1/h, and to the Stokeslet's own image, −9/(16h) and −9/(8h)."""
    x, h = bent_chain(1), np.array([1e2, 3e2, 1e3, 3e3, 1e4])
    far = [matrix(FLOOR, x + value * np.array([0, 0, 1])) for value in h]
    assert log_slope(h, [np.linalg.norm(m) for m in far]) == pytest.approx(-1, abs=0.01)
    n = len(x)
    limit = np.tile(np.diag([9 / 16, 9 / 16, 9 / 8]), (n, n))
    assert_allclose(-h[-1] * far[-1], limit, rtol=0, atol=2e-3)


@pytest.mark.parametrize("wall", [FLOOR, OBLIQUE], ids=["floor", "oblique"])
def test_velocity_is_matrix_times_force_and_both_add(wall):
    """The pair sum that never forms the matrix gives the matrix times the forces; both keep what is there."""
    x, rng = above(wall, crumpled_chain(5)), np.random.default_rng(6)
    force, u, m = rng.normal(size=x.shape), rng.normal(size=x.shape), rng.normal(size=(x.size, x.size))
    before, m_before = u.copy(), m.copy()
    wall.add_velocity(x, force, u)
    wall.add_matrix(x, m)
    assert_allclose((u - before).ravel(), matrix(wall, x) @ force.ravel(), rtol=0, atol=1e-13)
    assert_allclose(m - m_before, matrix(wall, x), rtol=0, atol=1e-14)


def test_invariant_under_shifts_along_the_wall():
    """Beads moved along an oblique wall, and the wall's point moved along it, leave ΔM as it was."""
    x = above(OBLIQUE, crumpled_chain(2))
    along = 11.0 * np.cross(OBLIQUE.normal, [1.0, 0.0, 0.0])
    assert_allclose(matrix(OBLIQUE, x + along), matrix(OBLIQUE, x), rtol=0, atol=1e-14)
    moved = WallCorrection(tuple(np.array(OBLIQUE.point) + along), OBLIQUE.normal)
    assert_allclose(matrix(moved, x), matrix(OBLIQUE, x), rtol=0, atol=1e-14)


ROTATIONS = {
    **{f"random {seed}": random_rotation(seed, 3) for seed in range(5)},
    **{f"x by {angle}": Rotation.from_euler("x", angle, degrees=True).as_matrix() for angle in (90, -90, 180)},
    "y by 90": Rotation.from_euler("y", 90, degrees=True).as_matrix(),
    "nearly upside down": Rotation.from_euler("x", np.pi - 1e-9).as_matrix(),
    "just below level": Rotation.from_euler("x", np.pi / 2 + 1e-9).as_matrix(),
    "about the normal": Rotation.from_euler("z", 0.7).as_matrix(),
    "mirrored": np.diag([-1.0, 1.0, 1.0]),
}


@pytest.mark.parametrize("turn", ROTATIONS.values(), ids=ROTATIONS)
def test_scene_and_wall_turn_together(turn):
    """Moving and turning beads, forces and wall turns velocities, matrix and gradient, wherever the normal points."""
    x, rng = above(FLOOR, crumpled_chain(3)), np.random.default_rng(4)
    force, corner = rng.normal(size=x.shape), np.array([2.0, -1.0, 0.5])
    wall = WallCorrection(tuple(turn @ corner), tuple(turn[:, 2]))
    turned, turned_force = (x + corner) @ turn.T, force @ turn.T
    blocks = np.kron(np.eye(len(x)), turn)
    assert_allclose(wall.heights(turned), FLOOR.heights(x), rtol=0, atol=1e-13)
    assert_allclose(velocity(wall, turned, turned_force), velocity(FLOOR, x, force) @ turn.T, rtol=0, atol=1e-13)
    assert_allclose(matrix(wall, turned), blocks @ matrix(FLOOR, x) @ blocks.T, rtol=0, atol=1e-13)
    expected = blocks @ gradient(FLOOR, x, force) @ blocks.T
    assert_allclose(gradient(wall, turned, turned_force), expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("wall", [FLOOR, OBLIQUE], ids=["floor", "oblique"])
@pytest.mark.parametrize("chain", [bent_chain, crumpled_chain])
def test_gradient_taylor(wall, chain):
    """At fixed forces the error of ``ΔM(x + εv)F ≈ ΔM F + ε ∂(ΔM F)/∂x v`` falls as ε²."""
    x, rng = above(wall, chain(7)), np.random.default_rng(8)
    force, direction = rng.normal(size=x.shape), rng.normal(size=x.size)
    slope = taylor_slope(
        lambda y: velocity(wall, y.reshape(x.shape), force).ravel(),
        gradient(wall, x, force),
        x.ravel(),
        direction,
        [1e-3, 3e-4, 1e-4, 3e-5],
    )
    assert slope == pytest.approx(2, abs=0.1)


def test_gradient_equals_that_of_the_surface_averages():
    """Every entry equals the complex step through the averaged image tensor, to 1e-12."""
    x = np.array([[0.7, -1.2, 2.1], [0.0, 1.0, 2.6]])
    force = np.random.default_rng(9).normal(size=x.shape)
    shifts = 1j * STEP * np.eye(6).reshape(6, 2, 3)
    columns = [averaged_velocity(x + s, force, order=11).imag.ravel() / STEP for s in shifts]
    assert_allclose(gradient(FLOOR, x, force), np.transpose(columns), rtol=0, atol=1e-12)


def test_gradient_adds_to_a_larger_matrix():
    """Only the first 3N rows and columns of a (3N + 1)² array change, and by addition."""
    x, rng = above(OBLIQUE, bent_chain(9)), np.random.default_rng(10)
    force, jac = rng.normal(size=x.shape), rng.normal(size=(x.size + 1, x.size + 1))
    before = jac.copy()
    OBLIQUE.add_gradient(x, force, jac)
    assert_allclose((jac - before)[:-1, :-1], gradient(OBLIQUE, x, force), rtol=0, atol=1e-14)
    assert np.array_equal(jac[-1], before[-1])
    assert np.array_equal(jac[:, -1], before[:, -1])


def test_heights_are_positive_in_the_fluid():
    """Heights count from the wall along the normal: zero on the wall, negative behind it."""
    point, normal = np.array(OBLIQUE.point), np.array(OBLIQUE.normal)
    along = np.cross(normal, [0.0, 1.0, 0.0])
    x = point + np.array([2.5, 0.0, -1.0])[:, None] * normal + np.array([3.0, -7.0, 1.0])[:, None] * along
    assert_allclose(OBLIQUE.heights(x), [2.5, 0.0, -1.0], rtol=0, atol=1e-14)
