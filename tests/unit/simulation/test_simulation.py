"""What a run returns, when it ends, and what it records."""

import json

import numpy as np
import pytest

import sedfiber
from sedfiber import InputError, NumericalError, Numerics, Scene, simulate, steady_state
from sedfiber.simulation.settling import SETTLED, distance_to_terminal


@pytest.fixture(scope="module")
def settled():
    """A run to the end that the fiber itself sets."""
    return simulate(Scene(B=1000, theta0=0.7854))


def distance_of(run, B=1000):
    """Distance to the terminal shape over L at each sample."""
    return distance_to_terminal(run.shape, steady_state(B).positions, 62.0)


def test_public_interface(settled):
    """issue 2 §1: traj.t (T,), traj.positions (T, N, 3), samples every τ = 0.5 from t = 0."""
    assert settled.positions.shape == (len(settled.t), 31, 3)
    assert np.array_equal(settled.t, 0.5 * np.arange(len(settled.t)))
    assert settled.positions.flags.c_contiguous
    assert not settled.positions[..., 2].any()


def test_package_offers_the_public_names():
    """`import sedfiber` is all a user needs; unknown names are AttributeErrors."""
    for name in ("Scene", "simulate", "steady_state", "Numerics", "read_trajectory", "write_trajectory"):
        assert callable(getattr(sedfiber, name))
        assert name in dir(sedfiber)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = sedfiber.nothing


def test_starts_straight_at_the_angle(settled):
    """The first sample is the scene's start, bit for bit."""
    assert np.array_equal(settled.positions[0, :, :2], Scene(1000, 0.7854).start())


def test_centre_and_shape(settled):
    """centre is bead 15; shape has it at the origin; together they are the positions."""
    assert np.array_equal(settled.centre, settled.positions[:, 15])
    assert not settled.shape[:, 15].any()
    assert settled.n_beads == 31


def test_record_ends_at_the_first_sample_after_settling(settled):
    """T lies within the last interval; only the last sample is below the threshold."""
    assert settled.t[-2] < settled.settling_time <= settled.t[-1]
    distance = distance_of(settled)
    assert distance[-1] < SETTLED <= distance[-2]


def test_settling_time_is_the_last_crossing(settled):
    """Running on for twice the time finds the same T: the fiber stays settled."""
    longer = simulate(Scene(1000, 0.7854), t_end=2 * settled.t[-1])
    assert longer.settling_time == pytest.approx(settled.settling_time, abs=1e-9)
    assert np.array_equal(longer.positions[: len(settled.t)], settled.positions)


@pytest.mark.parametrize(
    ("t_end", "interval", "samples"), [(10, 0.5, 21), (10.4, 0.5, 21), (0.3, 0.1, 4), (0.7, 0.1, 8), (0.2, 0.5, 1)]
)
def test_t_end_is_the_last_sample_at_or_before_it(t_end, interval, samples):
    """Also where 0.3/0.1 is 2.9999999999999996 in floating point."""
    run = simulate(Scene(1000, 0.5, 11), Numerics(interval=interval), t_end)
    assert len(run.t) == samples
    assert run.t[-1] <= t_end * (1 + 1e-12)


def test_short_run_has_not_settled():
    """No settling time, and None in the file, rather than a number that means nothing."""
    run = simulate(Scene(1000, 0.5), t_end=5.0)
    assert run.settling_time is None
    assert run.metadata["settling_time"] is None


def test_metadata_is_plain_complete_and_deterministic(settled):
    """Everything DESIGN §3 asks for, as JSON without NaN, the same on a second run."""
    facts = settled.metadata
    assert facts["kind"] == "simulation"
    assert (facts["B"], facts["B_force_consistent"]) == (1000.0, pytest.approx(2000 / 3))
    assert facts["modulus"] == pytest.approx(714.984)
    assert facts["scene"]["theta0"] == facts["scene"]["start_angle"] == 0.7854
    assert facts["scene"]["seed"] == 0
    assert facts["numerics"] == {
        "integrator": "LSODA", "rtol": 1e-8, "atol": 1e-8, "interval": 0.5, "max_time": 1e5, "t_end": None,
        "estimate_error": False,
    }  # fmt: skip
    assert set(facts["counters"]) == {"steps", "rhs", "jacobians", "factorisations"}
    assert min(facts["counters"].values()) > 0
    checks = facts["checks"]
    assert checks["bond_strain_max"] < checks["strain_bound"] == pytest.approx(31 / 714.984)
    assert checks["smallest_gap"] > 0.0
    assert checks["energy_imbalance"] < checks["energy_bound"]
    assert json.loads(json.dumps(facts, allow_nan=False)) == facts
    again = simulate(Scene(B=1000, theta0=0.7854))
    assert again.metadata == facts
    assert again.positions.tobytes() == settled.positions.tobytes()


def test_recorded_scene_rebuilds_the_run(settled):
    """The metadata is enough to run the same scene again."""
    recorded = dict(settled.metadata["scene"])
    recorded.pop("start_angle")
    assert Scene.from_dict(recorded) == Scene(1000, 0.7854)


def test_tilted_start_is_recorded():
    """θ₀ = 0 stays in the record, beside the angle that the run really started at."""
    scene = simulate(Scene(1000, 0.0, tilt=2e-4, seed=1), t_end=1.0).metadata["scene"]
    assert scene["theta0"] == 0.0
    assert abs(scene["start_angle"]) == 2e-4
    assert (scene["tilt"], scene["seed"]) == (2e-4, 1)


def test_a_run_that_does_not_settle_in_time_is_an_error():
    """max_time bounds a run without an end; the message says what to do."""
    with pytest.raises(NumericalError, match=r"^not settled by t = 20 .*--t-end"):
        simulate(Scene(1000, 0.5), Numerics(max_time=20))


def test_rest_in_another_steady_shape_is_an_error():
    """An exactly vertical fiber falls straight for ever: steady, far from the U, and never called settled."""
    with pytest.raises(NumericalError, match=r"^came to rest .* 0\.\d+ L from the terminal"):
        simulate(Scene(1000, np.pi / 2))


@pytest.mark.parametrize("key", ["rtol", "atol", "interval", "max_time"])
@pytest.mark.parametrize("value", [0, -1, float("nan"), float("inf"), "small"])
def test_bad_numerics_are_refused_by_name(key, value):
    """One line with key and value."""
    with pytest.raises(InputError, match=f"^{key}: .* is not allowed"):
        Numerics(**{key: value})


def test_unknown_integrators_are_refused():
    """The message lists those on offer."""
    with pytest.raises(InputError, match=r"^integrator: 'Euler' .* BDF, Radau, LSODA, dopri5"):
        Numerics("Euler")


@pytest.mark.parametrize("t_end", [0, -5, float("nan"), "soon"])
def test_bad_ends_are_refused(t_end):
    """t_end is a time above zero."""
    with pytest.raises(InputError, match=r"^t_end: "):
        simulate(Scene(1000, 0.5), t_end=t_end)
