"""Scenes against theory from outside: falling pairs, a bead nearing a wall, a relaxing fiber, plane against volume."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp

from problems import rms_distance
from sedfiber import Numerics, Scene, simulate
from sedfiber.scene.assembly import assemble

TIGHT = Numerics(rtol=1e-10, atol=1e-10, interval=0.5)


def stimson_jeffery(distance):
    """Drag factor λ of two equal spheres falling along their line of centres (Stimson & Jeffery 1926, eq. 37).

    Each falls at 1/λ times the speed it has alone; cosh α is half the distance of centres over the radius.
    """
    alpha, n = np.arccosh(distance / 2), np.arange(1, 5000)
    half, whole = np.minimum((n + 0.5) * alpha, 300), np.minimum((2 * n + 1) * alpha, 600)
    numerator = 4 * np.sinh(half) ** 2 - (2 * n + 1) ** 2 * np.sinh(alpha) ** 2
    terms = 1 - numerator / (2 * np.sinh(whole) + (2 * n + 1) * np.sinh(2 * alpha))
    return 4 / 3 * np.sinh(alpha) * (n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * terms).sum()


def pair_speed(distance, upright):
    """Falling speed of two free beads side by side, or one above the other, as a scene of two one-bead fibers."""
    place = [0, distance] if upright else [distance, 0]
    pair = Scene(1000, 0.0, 1, fibers=[{}, {"place": place}], hydrodynamics="RPY-overlap")
    run = simulate(pair, Numerics(t_end=5))
    moved = run.positions[-1] - run.positions[0]
    assert_allclose(moved[0], moved[1], rtol=0, atol=1e-12)  # equal beads keep their distance
    return -moved[0, 1] / 5


def test_stimson_jeffery_series_has_its_known_limits():
    """λ is 0.645 for touching spheres (their table: 0.645) and tends to 1 − 3/(2r) far apart."""
    assert stimson_jeffery(2.0001) == pytest.approx(0.645, abs=1e-3)
    assert stimson_jeffery(200.0) == pytest.approx(1 - 1.5 / 200, abs=1e-4)


def test_two_beads_one_above_the_other_fall_as_stimson_and_jeffery_say():
    """Rotne–Prager is the exact answer to order (a/r)³; what is missing falls as r⁻⁴ and is 5 % at touching."""
    distance = np.array([4.0, 6.0, 8.0, 12.0, 16.0])
    error = np.array([pair_speed(r, upright=True) * stimson_jeffery(r) - 1 for r in distance])
    assert np.polyfit(np.log(distance), np.log(np.abs(error)), 1)[0] == pytest.approx(-4, abs=0.3)
    assert abs(error[0]) < 0.01
    assert pair_speed(2.0, upright=True) == pytest.approx(1 / 0.645, rel=0.05)


@pytest.mark.parametrize("r", [2.0, 3.0, 10.0])
def test_two_beads_side_by_side_fall_with_the_faxen_interaction(r):
    """Smoluchowski 1911 with Faxén's finite size: 1 + 3/(4r) + 1/(2r³)."""
    assert pair_speed(r, upright=False) == pytest.approx(1 + 0.75 / r + 0.5 / r**3, rel=1e-9)


def falling_bead(t_end):
    """One bead released ten radii above a floor."""
    wall = {"point": [0, -10, 0]}
    return simulate(Scene(1000, 0.0, 1, space="volume", hydrodynamics="RPY-overlap", wall=wall), TIGHT, t_end)


def test_a_bead_falls_to_a_wall_at_the_known_self_mobility():
    """t(h) = ∫ dh/M(h) with M = 1 − 9/(8h) + 1/(2h³) − 1/(8h⁵) (Blake's image with both Faxén terms), by quadrature."""

    def mobility(h):
        return 1 - 9 / (8 * h) + 1 / (2 * h**3) - 1 / (8 * h**5)

    run = falling_bead(12.5)
    heights = run.positions[:, 0, 1] + 10
    times = [quad(lambda h: 1 / mobility(h), end, 10.0, epsabs=1e-12)[0] for end in heights[::4]]
    assert 1.0 < heights[-1] < 1.6
    assert_allclose(times, run.t[::4], rtol=0, atol=1e-7)
    assert not run.positions[:, 0, [0, 2]].any()


def test_a_bead_falls_to_a_wall_as_brenner_says_until_it_is_near():
    """Brenner 1961, the exact drag, by the fit of Bevan & Prieve 2000, M = (6z² + 2z)/(6z² + 9z + 2), z = h − 1, good
    to 0.5 %: down to a gap of one radius the bead is where the exact law puts it to 2 % of its way.
    """

    def speed(t, h):
        z = h - 1
        return -(6 * z**2 + 2 * z) / (6 * z**2 + 9 * z + 2)

    run = falling_bead(12.0)
    exact = solve_ivp(speed, (0, 12), [10.0], t_eval=run.t, rtol=1e-10, atol=1e-10).y[0]
    far = exact > 2.0
    assert far.sum() > 20
    assert np.abs(run.positions[far, 0, 1] + 10 - exact[far]).max() < 0.02 * 10


def bending_rates(n_beads, modulus):
    """Decay rates and modes of small deflections without hydrodynamic interaction: ẏ = −(ℰ/32) D₂ᵀD₂ y.

    The angle at bead i is (y_{i−1} − 2y_i + y_{i+1})/2, its energy (ℰ/8) θ²/2.
    """
    second = np.diff(np.eye(n_beads), 2, axis=0)
    return np.linalg.eigh(modulus / 32 * second.T @ second)


@pytest.mark.parametrize("mode", [2, 3, 5])
def test_a_bent_fiber_relaxes_at_its_linear_rates(mode):
    """Free-draining beads released in one bending mode of 1e-4 a keep its shape and decay at its rate to 1e-6."""
    scene = Scene(1000, 0.0, 31)
    rates, modes = bending_rates(31, scene.modulus)
    x = np.column_stack([2.0 * np.arange(-15, 16), 1e-4 * modes[:, mode]])
    t_end = 2.0 / rates[mode]
    bent = Scene(1000, 0.0, 31, hydrodynamics="none", gravity=None, shape=x.tolist())
    run = simulate(bent, Numerics(rtol=1e-11, atol=1e-13, interval=t_end / 20), t_end)
    amplitude = run.positions[:, :, 1] @ modes[:, mode]
    assert np.polyfit(run.t, np.log(amplitude), 1)[0] == pytest.approx(-rates[mode], rel=1e-6)
    start = run.positions[0, :, 1] @ modes[:, mode]
    rest = run.positions[-1, :, 1] - np.outer(amplitude[-1:], modes[:, mode])[0]
    mean = modes[:, :2] @ (modes[:, :2].T @ rest)  # a shift and a turn, which do not decay
    assert np.abs(rest - mean).max() < 1e-5 * start


@pytest.mark.parametrize(("mode", "beta"), [(2, 4.730041), (3, 7.853205)])
def test_the_linear_rates_are_those_of_a_free_beam(mode, beta):
    """Euler–Bernoulli with friction 1/(2a) per length: ẏ = −(ℰ/2) y'''' on a length 2(N − 1), and a bit more at the
    ends; β from cos β cosh β = 1.  The discrete rates come to the continuous ones as 1/N.
    """
    errors = []
    for n in (31, 61, 121, 241):
        continuous = 0.5 * (beta / (2 * (n - 1))) ** 4
        errors.append(1 - bending_rates(n, 1.0)[0][mode] / continuous)
    assert np.polyfit(np.log([31, 61, 121, 241]), np.log(errors), 1)[0] == pytest.approx(-1, abs=0.1)
    assert errors[-1] < 0.03


def fixed_steps(scene, t_end, step):
    """Positions at the end by classical Runge–Kutta with fixed steps: no step-size control that could differ."""
    system = assemble(scene)
    y = system.to_state(scene.start())
    samples = [y]
    for k in range(round(t_end / step)):
        k1 = system.rhs(0.0, y)
        k2 = system.rhs(0.0, y + step / 2 * k1)
        k3 = system.rhs(0.0, y + step / 2 * k2)
        k4 = system.rhs(0.0, y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if k % 500 == 499:
            samples.append(y)
    return system.to_positions(np.array(samples))


@pytest.mark.slow
def test_plane_and_volume_agree_to_round_off_for_the_whole_fall():
    """ℬ = 1000 from π/4 until settled: fixed steps in 2N and in 3N coordinates differ by less than 1e-12 L at every
    sample, and z stays exactly zero.
    """
    plane, volume = (fixed_steps(Scene(1000, np.pi / 4, space=space), 150.0, 1.5e-3) for space in ("plane", "volume"))
    assert simulate(Scene(1000, np.pi / 4)).settling_time < 150.0
    assert not volume[..., 2].any()
    assert rms_distance(plane, volume, 62.0).max() < 1e-12
