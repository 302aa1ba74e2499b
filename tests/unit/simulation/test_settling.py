"""Distance to the terminal shape, and when it is called settled."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

from problems import bent_chain
from sedfiber.simulation.settling import SETTLED, distance_to_terminal, settling_time

TERMINAL = bent_chain(0, n_beads=11) * [1.0, 1.0, 0.0]  # a planar shape
LENGTH = 22.0
HIGHER = np.array([0.0, 0.22, 0.0])  # by 0.01 L


def turned(x, angle):
    """A rotation about gravity, the y-axis."""
    c, s = math.cos(angle), math.sin(angle)
    return x @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T


@given(angle=st.floats(-math.pi, math.pi), facing=st.floats(-math.pi, math.pi))
def test_turning_about_gravity_is_no_distance(angle, facing):
    """A turned steady shape is a steady shape, whichever way the reference faces; x → −x is the half turn."""
    assert distance_to_terminal(turned(TERMINAL, angle), turned(TERMINAL, facing), LENGTH) < 1e-7


@pytest.mark.parametrize("axis", [0, 2])
def test_turning_about_another_axis_is_distance(axis):
    """Only the turn about gravity is free: lying on its side is not settled."""
    c, s = math.cos(0.3), math.sin(0.3)
    turn = np.eye(3)
    others = [k for k in range(3) if k != axis]
    turn[np.ix_(others, others)] = [[c, -s], [s, c]]
    assert distance_to_terminal(TERMINAL @ turn.T, TERMINAL, LENGTH) > 0.01


@pytest.mark.parametrize("seed", range(5))
def test_distance_is_the_least_over_all_turns(seed):
    """The closed form equals a numerical minimum over the angle."""
    shape = turned(TERMINAL, seed) + np.random.default_rng(seed).normal(scale=0.5, size=TERMINAL.shape)

    def rms(angle):
        return math.sqrt(((turned(shape, angle) - TERMINAL) ** 2).sum() / len(TERMINAL)) / LENGTH

    coarse = min(np.linspace(-math.pi, math.pi, 73), key=rms)
    least = minimize_scalar(rms, bounds=(coarse - 0.1, coarse + 0.1), method="bounded").fun
    assert distance_to_terminal(shape, TERMINAL, LENGTH) == pytest.approx(least, rel=1e-7)


def test_distance_by_hand():
    """Every bead 0.22 a too high, L = 22 a: a distance of 0.01; one bead of eleven: 0.01/√11."""
    assert distance_to_terminal(TERMINAL + HIGHER, TERMINAL, LENGTH) == pytest.approx(0.01, rel=1e-6)
    one = TERMINAL.copy()
    one[3, 1] += 0.22
    assert distance_to_terminal(one, TERMINAL, LENGTH) == pytest.approx(0.01 / math.sqrt(11), rel=1e-6)


def test_distance_of_a_history():
    """One number per sample."""
    history = np.array([TERMINAL, TERMINAL + HIGHER])
    assert_allclose(distance_to_terminal(history, TERMINAL, LENGTH), [0, 0.01], atol=1e-7)


@pytest.mark.parametrize("rate", [0.05, 0.3, 2.0])
@pytest.mark.parametrize("spacing", [0.5, 0.37])
def test_settling_time_of_an_exponential_is_exact(rate, spacing):
    """exp(−λt) falls below 1e-3 at ln(1000)/λ, between samples, and the interpolation is exponential."""
    t = spacing * np.arange(1000)
    assert settling_time(t, np.exp(-rate * t)) == pytest.approx(math.log(1000) / rate, rel=1e-9)


def test_last_crossing_counts():
    """A distance that dips below the threshold and comes back has settled only after it stays below."""
    t = np.arange(7.0)
    distance = SETTLED * np.array([100, 0.5, 0.1, 2, 10, 0.1, 0.01])
    assert settling_time(t, distance) == pytest.approx(4.5)  # 10 → 0.1 falls through 1 half-way in the logarithm


def test_never_settled():
    """None when the last sample is still above, even after an earlier dip."""
    t = np.arange(3.0)
    assert settling_time(t, SETTLED * np.array([5.0, 0.5, 3.0])) is None
    assert settling_time(t[:1], SETTLED * np.array([5.0])) is None


def test_settled_from_the_start():
    """A start that is already there settles at its first sample."""
    assert settling_time(np.array([2.0, 3.0]), SETTLED * np.array([0.5, 0.1])) == 2.0


def test_the_threshold_itself_is_not_below():
    """'Stays below 1e-3 L' is a strict bound (DESIGN §1)."""
    t = np.arange(3.0)
    assert settling_time(t, SETTLED * np.array([10.0, 1.0, 0.1])) == pytest.approx(1.0)
    assert SETTLED == 1e-3
