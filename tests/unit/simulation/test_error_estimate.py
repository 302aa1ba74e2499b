"""The error estimate of a run: near the true error, never silent about a loose run that went astray."""

import numpy as np
import pytest

from sedfiber import NumericalError, Numerics, Scene, simulate
from sedfiber.simulation.differences import largest_distance, rms_distance

TRUTH = Numerics("Radau", 1e-12, 1e-12)


@pytest.mark.parametrize(("B", "theta0"), [(1000, 0.7), (10000, 0.0)])
@pytest.mark.parametrize("method", ["LSODA", "BDF"])
def test_estimate_is_the_true_error_to_a_tenth(B, theta0, method):
    """Against Radau at 1e-12, whose steps share nothing with those of the estimate."""
    scene = Scene(B, theta0)
    run = simulate(scene, Numerics(method, 1e-7, 1e-7, estimate_error=True), 150.0)
    truth = simulate(scene, TRUTH, 150.0)
    true_error = largest_distance(run.positions, truth.positions, scene.length)
    assert run.metadata["error_estimate"] == pytest.approx(true_error, rel=0.1)


def test_estimate_changes_nothing_else():
    """The run with an estimate is the run without it, counters included."""
    scene = Scene(1000, 0.7, 11)
    plain = simulate(scene)
    estimated = simulate(scene, Numerics(estimate_error=True))
    assert plain.positions.tobytes() == estimated.positions.tobytes()
    assert plain.metadata["counters"] == estimated.metadata["counters"]
    assert plain.metadata["error_estimate"] is None
    assert 0.0 < estimated.metadata["error_estimate"] < 1e-6


def test_loose_runs_are_estimated_unasked():
    """At 1e-4 the estimate is in the record, within five times the tolerance."""
    run = simulate(Scene(1000, 0.7), Numerics("Radau", 1e-4, 1e-4))
    assert 0.0 < run.metadata["error_estimate"] < 5e-4


def test_a_loose_run_that_goes_astray_is_an_error():
    """BDF at 1e-2 passes every other check at ℬ = 10000 from θ₀ = 0, and is 0.14 L off."""
    with pytest.raises(NumericalError, match=r"differs by 0\.\d+ L .* more than 5 times its own \(0.01\)"):
        simulate(Scene(10000, 0.0), Numerics("BDF", 1e-2, 1e-2))


def test_noise_has_no_estimate():
    """A random motion follows no tolerance."""
    scene = Scene(1000, 0.7, 5, noise={"peclet": 100.0, "step": 1e-3})
    assert simulate(scene, Numerics(estimate_error=True), 1.0).metadata["error_estimate"] is None


def test_distances_by_hand():
    """Two beads, one of them 3 and 4 off: √(25/2)/L."""
    one, other = np.zeros((2, 2, 3)), np.zeros((2, 2, 3))
    other[1, 0] = [3.0, 4.0, 0.0]
    assert rms_distance(one, other, 10.0) == pytest.approx([0.0, np.sqrt(12.5) / 10.0])
    assert largest_distance(one, other, 10.0) == pytest.approx(np.sqrt(12.5) / 10.0)
