"""Where the steady states are stable: every rate run as well as computed, every threshold from its two sides."""

import math
from dataclasses import replace

import numpy as np
import pytest

from problems import rms_distance
from sedfiber import NumericalError, Scene, simulate, steady_state
from sedfiber.scene.numerics import Numerics
from sedfiber.simulation.equilibria.branches import Vertical, trace_sections
from sedfiber.simulation.equilibria.growth import measured_rate
from sedfiber.simulation.equilibria.plane_stability import threshold
from sedfiber.simulation.equilibria.spectrum import spectrum
from sedfiber.simulation.equilibria.states import disagreement, state_rows, threshold_rows
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.equilibria.vertical import vertical_rates, vertical_state

ENDS = (10.0, 100_000.0)
GRID = np.geomspace(*ENDS, 13).tolist()
SCENE = Scene(ENDS[0], 0.0)


@pytest.fixture(scope="module")
def branches():
    """U, W and middle section of the study's fiber, and the vertical one, three states per factor of ten."""
    sections, remark = trace_sections(SCENE, *ENDS)
    assert remark == ""
    return [*sections, Vertical(SCENE, GRID)]


@pytest.fixture(scope="module")
def rows(branches):
    """The table of states."""
    return [row for branch in branches for row in state_rows(branch, GRID, *ENDS)]


@pytest.fixture(scope="module")
def thresholds(branches):
    """The table of thresholds, by branch and kind."""
    return {(row["branch"], row["threshold"]): row for row in threshold_rows(branches, *ENDS)}


def test_measured_growth_is_the_predicted_one(rows):
    """Integrated from a disturbance along the leading mode: within 1 % on every branch, in the plane and across."""
    largest, compared, left_out = disagreement(rows)
    assert {row["branch"] for row in rows} == {"U", "W", "middle", "vertical"}
    assert largest < 0.01
    assert (compared, left_out) == (2 * len(rows), 0)


def test_every_state_is_steady(rows):
    """No bead moves relative to the centre bead by more than 1e-10 U_s; each row is at its ℬ or at a fold."""
    assert max(row["residual"] for row in rows) < 1e-10
    on_grid = [row["B"] in GRID for row in rows]
    assert [row["B"] for row, on in zip(rows, on_grid, strict=True) if not on] == pytest.approx(
        [63299.39, 6975.036, 6975.036, 63299.39], rel=1e-6
    )
    assert [row["B"] for row in rows if row["branch"] == "U"][:12] == GRID[:12]


def test_a_row_says_what_its_rates_say(rows):
    """Stable in the plane: all in-plane rates negative; in volume: the others too.  The W's symmetric rate is."""
    for row in rows:
        in_plane = row["in_plane_rate"] < 0.0
        assert row["stable_in_plane"] == in_plane
        assert row["stable_in_volume"] == (in_plane and row["out_of_plane_rate"] < 0.0)
    on_w = [row for row in rows if row["branch"] == "W" and row["B"] in GRID]
    assert all(row["in_plane_symmetric_rate"] < 0.0 < row["in_plane_rate"] for row in on_w)


def test_the_thresholds_are_all_there(thresholds):
    """Of N = 31 with RPY from ℬ = 10 to 100000: six."""
    found = {key: row["B"] for key, row in thresholds.items()}
    assert found == pytest.approx(
        {
            ("U", "fold"): 63299.39,
            ("U", "in-plane rate changes sign"): 46740.37,
            ("U", "out-of-plane rate changes sign"): 3699.196,
            ("W", "fold"): 6975.036,
            ("W", "out-of-plane rate changes sign"): 45127.27,
            ("vertical", "number of unstable modes changes"): 13544.63,
        },
        rel=1e-6,
    )
    assert all(row["accuracy"] < 1e-6 for row in thresholds.values())


def test_runs_on_both_sides_of_a_threshold_grow_and_decay(thresholds):
    """0.1 % below and above it, measured by time integration, the rate has opposite signs; a fold has no sides.

    On the W this is a rate of 4e-5 out of the plane, while round-off within the plane grows at 0.054.
    """
    for (_, kind), row in thresholds.items():
        if kind == "fold":
            assert math.isnan(row["rate_below"]) and math.isnan(row["rate_above"])
        else:
            assert row["rate_below"] * row["rate_above"] < 0.0
            assert abs(row["rate_below"]) == pytest.approx(abs(row["rate_above"]), rel=0.01)


def test_the_u_leaves_the_plane_where_the_older_search_says(thresholds):
    """compare_third_dimension solves at each ℬ anew and finds the root by ℬ."""
    assert thresholds["U", "out-of-plane rate changes sign"]["B"] == pytest.approx(
        threshold(SCENE, 3000, 4500), rel=2e-6
    )


def leading(B, branch="U"):
    """Scene, positions and spectrum of a state solved anew."""
    scene = replace(SCENE, B=B)
    positions = terminal_state(scene, branch).positions
    return scene, positions, spectrum(scene, positions)


@pytest.mark.parametrize("side", [-1, 1])
def test_the_u_is_left_within_the_plane_above_46740(side):
    """A planar run from the U and 1e-4 a of its antisymmetric mode moves away above the threshold, back below it."""
    B = 46740.37 * (1 + 0.05 * side)
    scene, positions, modes = leading(B)
    start = positions[:, :2] + 1e-4 * modes.in_plane[0].right.real[:, :2]
    run = simulate(replace(scene, shape=start), Numerics(rtol=1e-10, atol=1e-10, interval=10.0), t_end=400.0)
    away = rms_distance(run.shape, positions, scene.length)
    assert np.log(away[-1] / away[0]) / 400.0 == pytest.approx(modes.in_plane_rate, rel=0.01)
    assert np.sign(modes.in_plane_rate) == side


@pytest.mark.parametrize("B", [10.0, 20.0])
def test_slow_growth_on_the_vertical_fiber_is_linear_in_B(B):
    """1.17e-4 ℬ: a rigid straight chain would not turn, its bending makes it."""
    assert vertical_rates(replace(SCENE, B=B))[0].real / B == pytest.approx(1.17e-4, rel=0.01)


@pytest.mark.parametrize("B", [300.0, 10_000.0])
def test_a_vertical_fiber_buckles_at_the_predicted_rate(B):
    """Released at π/2 − 1e-8: the slope of log inclination over the last stretch of linear growth, within 1 %."""
    rate = vertical_rates(replace(SCENE, B=B))[0].real
    run = simulate(Scene(B, math.pi / 2 - 1e-8), Numerics(rtol=1e-10, atol=1e-12, interval=1.0), t_end=12.0 / rate)
    ends = run.positions[:, -1] - run.positions[:, 0]
    inclination = np.abs(np.arctan2(ends[:, 0], np.abs(ends[:, 1])))
    late = run.t > 6.0 / rate
    assert inclination[late].max() < 0.01
    assert np.polyfit(run.t[late], np.log(inclination[late]), 1)[0] == pytest.approx(rate, rel=0.01)


def test_an_oscillating_pair_of_the_vertical_fiber_is_measured():
    """The second and third mode at ℬ = 30000 are a complex pair; its envelope grows at the real part."""
    scene = replace(SCENE, B=30_000.0)
    state = vertical_state(scene)
    mode = spectrum(scene, state.positions).out_of_plane[1]
    assert abs(mode.rate.imag) > 0.05 and mode.rate.real > 0.03
    assert measured_rate(scene, state.positions, mode, 0.3) == pytest.approx(mode.rate.real, rel=0.01)


def test_an_exactly_symmetric_fall_comes_to_rest_in_the_w():
    """ℬ = 10000 without a tilt: an independent way to the same shape and speed."""
    run, state = simulate(Scene(10_000.0, 0.0, tilt=0.0)), steady_state(10_000.0, branch="W")
    assert run.metadata["settled_to"] == "W"
    assert rms_distance(run.shape[-1:], state.positions, SCENE.length)[0] < 1e-6
    assert -np.diff(run.centre[-2:, 1])[0] / 0.5 == pytest.approx(state.speed, rel=1e-6)


def test_there_is_no_w_below_its_fold():
    """The refusal says where the fold is."""
    with pytest.raises(NumericalError, match=r"there is no W at B=6900; .* fold at B=6975\.04"):
        steady_state(6900.0, branch="W")
    assert steady_state(6976.0, branch="W").height < 16.0


def test_without_a_w_the_rest_is_traced():
    """Seven beads: the U ends in a fold at ℬ = 1016, stable until there, and no symmetric fall finds a W."""
    scene = Scene(10.0, 0.0, 7)
    sections, remark = trace_sections(scene, 10.0, 2000.0)
    assert [section.name for section in sections] == ["U"]
    assert "no W found with 7 beads" in remark
    rows = state_rows(sections[0], [10.0, 1000.0, 2000.0], 10.0, 2000.0)
    assert [row["B"] for row in rows] == pytest.approx([10.0, 1000.0, 1016.083], rel=1e-6)
    assert [row["stable_in_volume"] for row in rows] == [True, True, False]  # at a fold one mode is neutral
    assert disagreement(rows)[1:] == (5, 1)
