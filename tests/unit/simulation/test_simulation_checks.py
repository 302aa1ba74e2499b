"""The checks after a run: each measures what it says, and each broken bound stops the run by name."""

from dataclasses import replace

import numpy as np
import pytest

from problems import bent_chain, straight_chain, system_of
from sedfiber import NumericalError, Scene, simulate
from sedfiber.simulation.checks import Checks, check
from sedfiber.simulation.recorded_run import Run

GOOD = Checks(
    bond_strain_max=0.01,
    strain_bound=0.04,
    smallest_gap=1.9,
    energy_imbalance=1e-8,
    energy_bound=1e-4,
    final_distance=1e-3,
    least_mobility=0.2,
)


def test_bounds_that_hold_pass():
    """Equality is within the bound."""
    GOOD.require()
    replace(GOOD, bond_strain_max=0.04, smallest_gap=-1.9, energy_imbalance=1e-4).require()


@pytest.mark.parametrize(
    ("broken", "named"),
    [
        ({"bond_strain_max": 0.05}, "bond strain 0.05 is above its bound 0.04"),
        (
            {"least_mobility": -0.01},
            r"not positive definite \(smallest eigenvalue -0.01\); give .*RPY-overlap",
        ),
        ({"energy_imbalance": 2e-4}, "energy imbalance 0.0002 is above its bound 0.0001"),
        ({"bond_strain_max": float("nan")}, "bond strain nan"),
        ({"least_mobility": float("nan")}, "not positive definite"),
        ({"energy_imbalance": float("nan")}, "energy imbalance nan"),
    ],
)
def test_broken_bounds_raise_by_name(broken, named):
    """One line: which bound, by how much, what to try.  NaN breaks every bound."""
    with pytest.raises(NumericalError, match=named) as error:
        replace(GOOD, **broken).require()
    assert "\n" not in str(error.value)


def run_of(system, shapes, work):
    """A made-up run: positions (T, N, d) and the work done by each sample."""
    states = np.array([system.to_state(x) for x in shapes])
    states[:, -1] = work
    return Run.of(system, np.arange(float(len(states))), states)


def test_strain_and_gap_are_the_extremes_over_the_run():
    """One bond of 2.2 a in the second sample: strain 0.1; beads two apart leave 2 a, or more, between them."""
    system, scene = system_of(n_beads=5), Scene(1000, 0.5, 5)
    rest, stretched = straight_chain(5, 2), straight_chain(5, 2)
    stretched[4, 0] += 0.2
    measured = check(scene, system, run_of(system, [rest, stretched], 0.0), 0.5)
    assert measured.bond_strain_max == pytest.approx(0.1)
    assert measured.smallest_gap == pytest.approx(2.0)
    assert measured.strain_bound == 5 / scene.modulus
    assert measured.least_mobility is None  # no two beads come near each other
    assert measured.final_distance == 0.5


def test_energy_imbalance_is_relative_to_the_whole_loss():
    """Five beads fall by 1 and then by 3 more: 20 units lost; work 5 and 20.2 leaves an imbalance of 1 %."""
    system = system_of(n_beads=5)
    falls = [bent_chain(0, 5, 2) - np.array([0.0, depth]) for depth in (0.0, 1.0, 4.0)]
    measured = check(Scene(1000, 0.5, 5), system, run_of(system, falls, [0.0, 5.0, 20.2]), 0.0)
    assert measured.energy_imbalance == pytest.approx(0.01)


def test_a_run_of_one_sample_is_in_balance():
    """Nothing has been lost yet."""
    system = system_of(n_beads=5)
    run = run_of(system, [straight_chain(5, 2)], 0.0)
    assert check(Scene(1000, 0.5, 5), system, run, 0.0).energy_imbalance == 0.0


def test_a_run_that_breaks_a_bound_is_no_result(monkeypatch):
    """simulate() raises instead of returning: here with a strain bound that no fiber can meet."""
    monkeypatch.setattr("sedfiber.simulation.checks.strain_bound", lambda scene: 1e-12)
    with pytest.raises(NumericalError, match="check failed: bond strain"):
        simulate(Scene(1000, 0.5, 11), t_end=2.0)


@pytest.mark.parametrize("r", [1.5, 1.0])
def test_the_mobility_is_examined_where_beads_overlap(r):
    """Two free beads r apart: plain RPY's smallest eigenvalue is 1 − c1 = 1 − 3/(4r) − 1/(2r³) or 1 − c1 − c2."""
    expected = 1 - max(0.75 / r + 0.5 / r**3, 1.5 / r - 1 / r**3)
    scene = Scene(1000, 0.5, 3)
    system = system_of(n_beads=3)
    x = np.array([[0.0, 0.0], [r, 0.0], [1e6, 0.0]])
    measured = check(scene, system, run_of(system, [straight_chain(3, 2), x], 0.0), 0.0)
    assert measured.least_mobility == pytest.approx(expected, abs=1e-5)
