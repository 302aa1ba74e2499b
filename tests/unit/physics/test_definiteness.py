"""A mobility that is not positive definite is found, and blamed by name."""

import numpy as np
import pytest

from problems import straight_chain, system_of
from sedfiber import InputError, NumericalError, Numerics, Scene, simulate
from sedfiber.physics.definiteness import closest_pair, indefinite_words, least_eigenvalue
from sedfiber.physics.free_draining import FreeDraining
from sedfiber.physics.pair_mobility import PairMobility


def pair(r):
    return np.array([[0.0, 0.0, 0.0], [r, 0.0, 0.0]])


def test_closest_pair_by_hand():
    """Beads 1 and 3 are 0.5 apart."""
    x = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 4.0], [3.5, 0.0]])
    assert closest_pair(x) == (1, 3, 0.5)


@pytest.mark.parametrize("r", [0.5, 1.0, 1.2, 1.9, 3.0])
def test_smallest_eigenvalue_of_a_pair(r):
    """1 − c1 across and 1 − c1 − c2 along, c1 = 3/(4r) + 1/(2r³), c1 + c2 = 3/(2r) − 1/r³."""
    expected = 1 - max(0.75 / r + 0.5 / r**3, 1.5 / r - 1 / r**3)
    assert least_eigenvalue(PairMobility("RPY", 3), pair(r)) == pytest.approx(expected)


def test_only_the_forms_that_can_lose_it_are_blamed():
    """At 0.3 a plain RPY is indefinite; the overlap form and no hydrodynamics are not."""
    assert "beads 0 and 1 are 0.3 a apart" in indefinite_words(PairMobility("RPY", 3), pair(0.3))
    assert indefinite_words(PairMobility("RPY-overlap", 3), pair(0.3)) is None
    assert indefinite_words(FreeDraining(), pair(0.3)) is None
    assert indefinite_words(PairMobility("RPY", 3), pair(2.0)) is None


def test_beads_in_one_place_have_no_eigenvalue():
    """All but: infinities count as indefinite."""
    with np.errstate(all="ignore"):
        assert least_eigenvalue(PairMobility("RPY", 3), pair(1e-110)) == -np.inf


def test_a_system_blames_its_state():
    """A chain whose last bead lies in its first."""
    x = straight_chain(5, 2)
    x[4] = x[0] + [0.0, 0.4]
    system = system_of(n_beads=5)
    words, remedy = system.loss_of_definiteness(system.to_state(x))
    assert "beads 0 and 4 are 0.4 a apart" in words and remedy == "give hydrodynamics RPY-overlap"
    assert system.loss_of_definiteness(system.to_state(straight_chain(5, 2))) is None


@pytest.mark.parametrize("method", ["LSODA", "BDF", "Radau", "dopri5"])
def test_a_collapse_is_explained_by_every_integrator(method):
    """Without bending, plain RPY pulls a chain together until no step succeeds; the error names the pair."""
    scene = Scene(1000, 0.7, bending=None)
    words = r"not positive definite .*beads \d+ and \d+ are .* a apart at t = 2\d\.\d+ a/U_s; give .*RPY-overlap"
    with pytest.raises(NumericalError, match=words):
        simulate(scene, Numerics(method), 100.0)


FLOOR = {"wall": {"point": [0.0, -30.0, 0.0]}, "space": "volume", "hydrodynamics": "RPY-overlap"}


@pytest.mark.parametrize(
    ("method", "interval"), [("LSODA", 0.5), ("BDF", 0.5), ("Radau", 0.5), ("dopri5", 0.5), ("Radau", 100.0)]
)
def test_a_bead_in_the_wall_ends_every_integration(method, interval):
    """At the first sample that finds it there, or where steps fail before; never with what the scene has."""
    words = rf"^{method}: bead \d+ is 0.\d+ a from the wall, less than its radius, at t = 1\d\.?\d* a/U_s; "
    with pytest.raises(NumericalError, match=f"{words}add contact, or a smaller t_end$"):
        simulate(Scene(100, 0.5, 31, **FLOOR), Numerics(method, interval=interval), 200.0)


def test_a_wall_that_contact_does_not_keep_beads_off():
    """Advice is not what the scene has already; with noise too, and with one bead."""
    weak = FLOOR | {"contact": {"strength": 0.01}}
    for parts in ({}, {"noise": {"peclet": 1e3, "step": 0.05}}):
        with pytest.raises(NumericalError, match=r"bead 0 is .* give a larger contact.strength, or a smaller t_end$"):
            simulate(Scene(100, 0.5, 1, **weak, **parts), t_end=100.0)


def test_many_beads_lose_it_before_two_do():
    """Two straight chains of five side by side, 1.2 a apart: a pair alone would be fine down to 1.13 a."""
    with pytest.raises(InputError, match=r"not positive definite for beads 0 and 5, 1.2 a apart"):
        Scene(1000, 0.0, 5, fibers=[{}, {"place": [0.0, 1.2]}], tilt=0.0)
