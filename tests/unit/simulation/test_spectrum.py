"""The spectrum at a steady state: eigenpairs of the equations of motion, neutral modes left out, adjoint modes."""

from dataclasses import replace

import numpy as np
import pytest

from sedfiber import Scene, steady_state
from sedfiber.scene.assembly import assemble
from sedfiber.simulation.equilibria.spectrum import leaving_rate, spectrum

SCENE = Scene(5000.0, 0.0)


@pytest.fixture(scope="module")
def steady():
    """Positions (31, 3) of the U at ℬ = 5000 and its modes."""
    positions = steady_state(SCENE.B).positions
    return positions, spectrum(SCENE, positions)


def linear_dynamics(positions, eps=1e-6):
    """``A`` of ``δ̇ = A δ`` in volume by central differences of the right-hand side, (93, 93): relative to the
    centre bead, whose own row and column are zero.
    """
    system = assemble(replace(SCENE, space="volume"))
    y, size = system.to_state(positions), positions.size
    A = np.zeros((size, size))
    for j in range(size):
        step = np.zeros(y.size)
        step[j] = eps
        A[:, j] = (system.rhs(0.0, y + step) - system.rhs(0.0, y - step))[:size] / (2 * eps)
    centre = slice(3 * system.centre, 3 * system.centre + 3)
    A[centre] = A[:, centre] = 0.0
    return A


def test_modes_are_eigenvectors_of_the_equations_of_motion(steady):
    """A · mode = rate · mode for the six fastest of each kind, with A by finite differences."""
    positions, modes = steady
    A = linear_dynamics(positions)
    for mode in (*modes.in_plane[:6], *modes.out_of_plane[:6]):
        np.testing.assert_allclose(A @ mode.right.ravel(), mode.rate * mode.right.ravel(), rtol=0, atol=1e-6)


def test_every_mode_but_the_turn_is_there(steady):
    """The rates are all eigenvalues of A; only the turn about gravity, and the centre bead's zeros, are missing."""
    positions, modes = steady
    assert (len(modes.in_plane), len(modes.out_of_plane)) == (60, 29)
    found = np.array([mode.rate for mode in (*modes.in_plane, *modes.out_of_plane)])
    reference = np.linalg.eigvals(linear_dynamics(positions))
    reference = reference[np.argsort(np.abs(reference))][4:]  # 3 of the centre bead, 1 of the turn
    np.testing.assert_allclose(np.sort_complex(found).real, np.sort_complex(reference).real, rtol=1e-5, atol=1e-6)


def neutral_displacements(positions):
    """Translations along x, y, z and the turn about gravity, each (N, 3) of largest size 1."""
    shifts = [np.tile(axis, (len(positions), 1)) for axis in np.eye(3)]
    turn = np.zeros_like(positions)
    turn[:, 2] = positions[:, 0] / np.abs(positions[:, 0]).max()
    return [*shifts, turn]


def test_translations_and_the_turn_about_gravity_are_neutral(steady):
    """The velocity Jacobian in volume maps them to nothing, to 1e-8."""
    positions, _ = steady
    jacobian = assemble(replace(SCENE, space="volume")).velocity_jacobian(positions)
    for neutral in neutral_displacements(positions):
        assert np.abs(jacobian @ neutral.ravel()).max() < 1e-8


def test_no_mode_is_neutral(steady):
    """Every rate is away from zero, no mode is the turn, and none holds any of it in its adjoint."""
    positions, modes = steady
    turn = neutral_displacements(positions)[-1]
    for mode in (*modes.in_plane, *modes.out_of_plane):
        assert abs(mode.rate) > 1e-3
        likeness = np.abs(np.vdot(mode.right, turn)) / np.linalg.norm(mode.right) / np.linalg.norm(turn)
        assert likeness < 0.999
        assert abs(mode.part(turn)) < 1e-6


def test_adjoint_modes_pick_their_own(steady):
    """part() of each mode in itself is 1, in every other 0; of a sum, its share; of a history, one a sample."""
    _, modes = steady
    some = (*modes.in_plane[:8], *modes.out_of_plane[:8])
    parts = np.array([[one.part(other.right) for other in some] for one in some])
    np.testing.assert_allclose(parts, np.eye(len(some)), rtol=0, atol=1e-8)
    history = np.stack([0.5 * some[0].right + 2.0 * some[1].right, some[0].right])
    np.testing.assert_allclose(some[0].part(history), [0.5, 1.0], rtol=1e-8)


def test_modes_are_in_the_plane_or_across_it_and_sorted(steady):
    """No in-plane mode moves along z, no other within the plane; the fastest growing comes first."""
    _, modes = steady
    assert not any(mode.right[:, 2].any() for mode in modes.in_plane)
    assert not any(mode.right[:, :2].any() for mode in modes.out_of_plane)
    for part in (modes.in_plane, modes.out_of_plane):
        assert (np.diff([mode.rate.real for mode in part]) <= 0).all()


def test_stability_is_read_off_the_rates(steady):
    """At ℬ = 5000, between 3699 and 46740, the U is stable in the plane but not in volume."""
    _, modes = steady
    assert modes.in_plane_rate < 0.0 < modes.out_of_plane_rate
    assert (modes.stable_in_plane, modes.stable_in_volume) == (True, False)


@pytest.mark.parametrize(("symmetric", "flat"), [(True, True), (False, True), (False, False), (True, False)])
def test_what_a_run_can_do_is_read_off_the_modes_it_can_have(steady, symmetric, flat):
    """A symmetric run has only symmetric modes of the plane, a flat one none across it."""
    positions, modes = steady
    own = [mode for mode in modes.in_plane if mode.symmetric or not symmetric] + ([] if flat else modes.out_of_plane)
    fastest = max(mode.rate.real for mode in own)
    assert leaving_rate(SCENE, positions, symmetric, flat) == pytest.approx(fastest, rel=1e-8)


def test_round_off_is_not_taken_for_growth():
    """At ℬ = 1e-6 the slowest rate, −1.2e-10, drowns in round-off of the stiffest, 2e7; nothing is called unstable."""
    scene = Scene(1e-6, 0.0)
    modes = spectrum(scene, steady_state(1e-6).positions)
    assert abs(modes.in_plane_rate) < modes.round_off
    assert modes.stable_in_volume
