"""The steady solver's interface, its choices and its refusals; tests/physics holds it against other methods."""

import numpy as np
import pytest

import sedfiber
from sedfiber import InputError, NumericalError, Scene, SteadyState, simulate, steady_state
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.equilibria.steady_curve import SteadyCurve


def test_public_interface():
    """issue 2 §1: state.positions (N, 3), state.velocity (3,), and what the command prints."""
    state = sedfiber.steady_state(B=1000)
    assert isinstance(state, SteadyState)
    assert state.positions.shape == (31, 3)
    assert state.velocity.shape == (3,)
    assert not state.positions[15].any()
    assert state.B == 1000.0


def test_measures_by_hand():
    """Height is the vertical extent, end to end the distance of the outer beads, speed the velocity's norm."""
    x = np.array([[-3.0, 2.0, 0.0], [0.0, 0.0, 0.0], [3.0, 1.0, 0.0]])
    state = SteadyState(1.0, x, np.array([0.0, -4.0, 3.0]), 0.0)
    assert state.height == 2.0
    assert state.end_to_end == pytest.approx(np.sqrt(37))
    assert state.speed == 5.0


@pytest.mark.parametrize("n_beads", [5, 11, 61])
def test_any_odd_number_of_beads(n_beads):
    """Short and long fibers reach 1e-10, or the round-off eps · N · ℰ of their own forces."""
    state = steady_state(50, n_beads)
    assert state.positions.shape == (n_beads, 3)
    assert state.residual < 1e-10 + np.finfo(float).eps * n_beads * Scene(50, 0.0, n_beads).modulus


def test_more_flexible_fibers_fold_more_and_fall_faster():
    """Along the U branch the ends come together and the speed rises with ℬ, from below the rigid chain's length."""
    states = [steady_state(B) for B in (10, 100, 1000, 10000)]
    assert (np.diff([s.end_to_end for s in states]) < 0).all()
    assert (np.diff([s.speed for s in states]) > 0).all()
    assert states[0].end_to_end == pytest.approx(60.0, rel=1e-3)


def test_same_answer_every_time():
    """Two solves give the same bits."""
    assert np.array_equal(steady_state(777).positions, steady_state(777).positions)


def test_answer_does_not_depend_on_how_far_the_branch_was_followed():
    """Neighbouring ℬ give neighbouring states: the continuation never jumps branch."""
    near = [steady_state(B).positions for B in (3000, 3000 * (1 + 1e-6))]
    assert np.abs(near[1] - near[0]).max() < 1e-3


@pytest.mark.parametrize("B", [0, -1, float("nan"), float("inf"), "text", None])
def test_bad_numbers_are_refused(B):
    """One line that names B."""
    with pytest.raises(InputError, match=r"^B: .* is not allowed"):
        steady_state(B)


@pytest.mark.parametrize(
    ("keys", "named"), [({"n_beads": 30}, "n_beads"), ({"hydrodynamics": "Stokes"}, "hydrodynamics")]
)
def test_other_bad_values_are_refused(keys, named):
    """The scene's own checks apply."""
    with pytest.raises(InputError, match=f"^{named}: "):
        steady_state(1000, **keys)


def test_settled_run_ends_where_the_solver_says():
    """The last sample of a run is within 1e-3 L of the steady shape, and falls at its speed to 1 %."""
    run, state = simulate(Scene(1000, 0.7854)), steady_state(1000)
    assert run.metadata["checks"]["final_distance"] < 1e-3
    assert -np.diff(run.centre[-2:, 1])[0] / 0.5 == pytest.approx(state.speed, rel=0.01)


@pytest.mark.parametrize("B", [0.1, 1e-2])
def test_nearly_rigid_fibers_deflect_linearly(B):
    """Deflection is linear in ℬ there: 5.9134e-4 L per ℬ (tests/physics/test_terminal_shape.py)."""
    assert steady_state(B).height / (62.0 * B) == pytest.approx(5.9134e-4, rel=0.01)


@pytest.mark.parametrize("B", [1e-3, 1e-6, 1e-12])
def test_however_stiff_the_deflection_is_linear(B):
    """The exact mirror symmetry takes out what round-off would hide the balance in."""
    assert steady_state(B).height / (62.0 * B) == pytest.approx(5.91341396e-4, rel=1e-6)


@pytest.mark.parametrize("factor", [0.1, 3.0, 100.0, 1e6])
def test_stiffer_springs_have_a_terminal_shape_as_well(factor):
    """Round-off of the springs is no reason to find none; the height differs by the strain of the bonds alone."""
    state, usual = terminal_state(Scene(1000, 0.5, stretching={"factor": factor})), steady_state(1000)
    assert state.height == pytest.approx(usual.height, rel=0.05 if factor < 1 else 0.01)


def test_a_shape_that_is_not_found_is_named_by_what_was_asked_for(monkeypatch):
    """Not by the ℬ from which the solver follows the curve alone."""
    monkeypatch.setattr(SteadyCurve, "nearest", lambda *_: None)
    with pytest.raises(NumericalError, match=r"for B=1000, 31 beads and stretching.factor 10: no nearly .* at B=10 to"):
        terminal_state(Scene(1000, 0.5, stretching={"factor": 10}))
