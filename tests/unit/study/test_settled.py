"""What a run settles to, and what it is not allowed to be called."""

import numpy as np
import pytest

from sedfiber import NumericalError, Numerics, Scene, simulate, steady_state
from sedfiber.study.hard_cases.symmetry_cases import asymmetry


@pytest.mark.parametrize(("B", "name"), [(4000, "U"), (10000, "W")])
def test_an_exactly_symmetric_fall_is_named(B, name):
    """The W at high ℬ, the U below its fold; mirror-symmetric to the last bit."""
    run = simulate(Scene(B, 0.0, tilt=0.0))
    assert run.metadata["settled_to"] == name
    assert (run.settling_time is None) == (name == "W")
    assert asymmetry(run.shape).max() == 0.0
    end = steady_state(B, branch=name).positions
    assert np.sqrt(((run.shape[-1] - end) ** 2).sum(1).mean()) < 1e-3 * 62


def test_a_run_that_hovers_at_the_w_is_not_called_settled():
    """From the W itself the fiber stays until round-off has grown; with an end before that it is named W."""
    w = steady_state(10000, branch="W").positions
    run = simulate(Scene(10000, 0.0, shape=w.tolist()), t_end=20.0)
    assert run.metadata["settled_to"] == "W"
    assert run.settling_time is None


def test_a_run_that_hovers_at_the_w_and_has_no_end_is_an_error():
    """It comes to rest at the unstable W, says so, and what to do."""
    w = steady_state(10000, branch="W").positions
    with pytest.raises(NumericalError, match=r"came to rest .* in the unstable W, 0\.26\d* L from the terminal"):
        simulate(Scene(10000, 0.0, shape=w.tolist()))


def test_the_vertical_fall_has_no_name():
    """Steady, and neither U nor W."""
    run = simulate(Scene(1000, np.pi / 2), t_end=200.0)
    assert run.metadata["settled_to"] is None
    assert run.settling_time is None


def test_planar_runs_settle_where_only_the_volume_is_unstable():
    """At ℬ = 10000 the U repels what leaves its plane; a planar run cannot, and neither can an exactly flat one."""
    for space in ("plane", "volume"):
        run = simulate(Scene(10000, 0.7, space=space), Numerics(rtol=1e-6, atol=1e-6))
        assert run.metadata["settled_to"] == "U"


def test_a_disturbed_run_in_volume_is_not_called_settled():
    """Out-of-plane disturbances grow at 0.0188 U_s/a: refused without an end, unnamed with one."""
    scene = Scene(10000, 0.7, space="volume", disturbance={"amplitude": 1e-9})
    with pytest.raises(NumericalError, match=r"the terminal U is unstable .* \(rate 0.0188 U_s/a\).*--t-end"):
        simulate(scene)
    run = simulate(scene, t_end=420.0)
    assert run.metadata["checks"]["final_distance"] < 1e-3  # near the U, on its way past it
    assert run.metadata["settled_to"] is None
    assert run.settling_time is None


def test_beyond_the_fold_a_run_needs_an_end():
    """No U exists at ℬ = 1e5; the message names the fold."""
    with pytest.raises(NumericalError, match=r"no U at B=100000; .* fold at B=63299.4; give --t-end"):
        simulate(Scene(1e5, 0.7))
