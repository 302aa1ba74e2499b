"""The yardsticks of costs: the paper's set-up as its text gives it, the timing of runs, the machine."""

import time

import numpy as np
import pytest
from numpy.testing import assert_allclose

from problems import bent_chain, system_of
from sedfiber import Scene
from sedfiber.scene.numerics import Numerics
from sedfiber.simulation.differences import largest_distance
from sedfiber.study.angles import angle_of
from sedfiber.study.costs.fall_problem import FallProblem
from sedfiber.study.costs.machine import machine, unit
from sedfiber.study.costs.source_setup import SourceSetup, forces
from sedfiber.study.costs.timing import FEW, REPEATS, timed_run

SECONDS = ["seconds_least", "seconds_median", "seconds_spread", "repeats"]


@pytest.mark.parametrize("seed", range(3))
def test_the_papers_right_hand_side_is_ours(seed):
    """Written from the text alone, in absolute coordinates: equal to round-off at a bent state in volume."""
    n_beads, B = 11, 1000.0
    system = system_of("volume", n_beads=n_beads)
    x = bent_chain(seed, n_beads)
    theirs = SourceSetup(24.0 * n_beads**3 / B).rhs(0.0, x.ravel()).reshape(-1, 3)
    expected = system.velocity(x)
    assert_allclose(theirs, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    ours = system.rhs(0.0, system.to_state(x))[:-1].reshape(-1, 3)
    relative = theirs - theirs[n_beads // 2]
    relative[n_beads // 2] = theirs[n_beads // 2]
    assert_allclose(relative, ours, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_the_papers_forces_of_a_fiber_at_rest_are_its_weight():
    """Straight and touching: no spring and no bend pulls."""
    x = np.zeros((5, 3))
    x[:, 0] = 2.0 * np.arange(5)
    assert_allclose(forces(x, 100.0), np.tile([0.0, -1.0, 0.0], (5, 1)), rtol=0, atol=1e-13)


def test_the_papers_run_agrees_with_ours():
    """1e-6 L over a sample that takes several calls, which give up after 500 steps and are made again."""
    fall = FallProblem(Scene(50.0, angle_of(5), 31), 2)
    theirs = SourceSetup(fall.scene.modulus).run(fall.start_positions, fall.samples)
    assert theirs.positions.shape == (2, 31, 3)
    assert theirs.steps > 500
    assert 6 * theirs.steps <= theirs.rhs
    ours = fall.by_numerics(Numerics(rtol=1e-10, atol=1e-10)).positions
    assert 0.0 < largest_distance(theirs.positions, ours, fall.scene.length) < 1e-6


def test_the_papers_run_stops_at_its_limit():
    """With no time at all it has its start; the counters start anew with each run."""
    fall = FallProblem(Scene(300.0, angle_of(5), 7), 21)
    setup = SourceSetup(fall.scene.modulus)
    whole = setup.run(fall.start_positions, 5)
    assert len(setup.run(fall.start_positions, 5, seconds=0.0).positions) == 1
    again = setup.run(fall.start_positions, 5)
    assert (again.rhs, again.steps) == (whole.rhs, whole.steps)


def test_short_runs_are_repeated_ten_times_and_long_ones_three(monkeypatch):
    """The first run says which: below a second, here none at all, it warms up; from there on it counts."""
    calls = []
    short = timed_run(lambda: calls.append("run") or "result")
    assert (short.repeats, calls.count("run"), short.returned) == (REPEATS, REPEATS + 1, "result")
    calls.clear()
    monkeypatch.setattr("sedfiber.study.costs.timing.LONG", 0.0)
    long = timed_run(lambda: calls.append("run"), lambda: None)
    assert (long.repeats, calls.count("run")) == (FEW, FEW)
    assert 0.0 <= long.least <= long.median and long.spread >= 0.0
    assert list(long.columns) == SECONDS


def test_a_very_long_run_is_not_repeated(monkeypatch):
    """Above 5 s, here 10 ms, one run is all."""
    monkeypatch.setattr("sedfiber.study.costs.timing.LONG", 0.01)
    monkeypatch.setattr("sedfiber.study.costs.timing.VERY_LONG", 0.01)
    calls = []
    assert timed_run(lambda: calls.append(time.sleep(0.02)), lambda: None).repeats == len(calls) == 1


def test_the_machine_is_one_line_and_the_unit_a_time():
    """Processor, threads and versions; microseconds."""
    assert "\n" not in machine() and "NumPy" in machine() and "thread" in machine()
    assert unit() > 0.0
