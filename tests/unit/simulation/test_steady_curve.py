"""The curve of steady shapes: its tangent, its folds, root finding along it, and its derivative by log ℬ."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from problems import taylor_slope
from sedfiber import Scene, steady_state
from sedfiber.simulation.equilibria import steady_curve
from sedfiber.simulation.equilibria.spectrum import spectrum
from sedfiber.simulation.equilibria.steady import state_of, straight_point, w_point
from sedfiber.simulation.equilibria.steady_curve import CurvePoint, SteadyCurve

SCENE = Scene(10_000.0, 0.0)
W_FOLD, U_FOLD = 6975.03622074, 63299.3900991  # ℬ, N = 31


@pytest.fixture(scope="module")
def curve():
    """That of the study's fiber."""
    return SteadyCurve(SCENE)


def point_at(curve, B):
    """The U at one ℬ."""
    return curve.nearest(B, steady_state(B).positions[:, :2])


def first_fold(curve, seed):
    """The first fold on the way along the seed's tangent."""
    steps = curve.follow(seed)
    for last, point in pairwise([seed, *(next(steps) for _ in range(200))]):
        if last.tangent[-1] * point.tangent[-1] < 0:
            return curve.fold(last, point)
    raise AssertionError("no fold within 200 steps")


def down_from_w(curve):
    """A W at ℬ = 10000, with its tangent towards smaller ℬ."""
    seed = w_point(SCENE, curve)
    return CurvePoint(seed.unknowns, -seed.tangent)


@pytest.mark.parametrize("B", [50.0, 300.0, 10_000.0])
def test_tangent_is_the_direction_of_neighbouring_states(curve, B):
    """dh/dλ from the solver at ℬ e^±ε agrees with the tangent to O(ε²)."""
    eps = 1e-4
    point = point_at(curve, B)
    ahead, behind = (point_at(curve, B * np.exp(side * eps)).unknowns for side in (1, -1))
    slope = (ahead - behind) / (2 * eps)
    np.testing.assert_allclose(slope, point.tangent / point.tangent[-1], rtol=0, atol=1e-5)


def test_derivative_by_log_B_by_taylor(curve):
    """The balance and its derivatives: the error of the linear model falls with the square of the step."""
    unknowns = point_at(curve, 1000.0).unknowns
    matrix = curve._linearise(unknowns)[1]
    along_B = np.append(np.zeros(len(unknowns) - 1), 1.0)
    for direction in (along_B, np.random.default_rng(0).normal(size=len(unknowns))):
        slope = taylor_slope(lambda y: curve._linearise(y)[0], matrix, unknowns, direction, [1e-2, 3e-3, 1e-3])
        assert slope == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("longest", [0.25, 0.05])
def test_folds_do_not_depend_on_the_step(curve, monkeypatch, longest):
    """Both folds to 1e-9, with steps five times shorter too."""
    monkeypatch.setattr(steady_curve, "_LONGEST_STEP", longest)
    assert pytest.approx(W_FOLD, rel=1e-9) == first_fold(curve, down_from_w(curve)).B
    assert pytest.approx(U_FOLD, rel=1e-9) == first_fold(curve, straight_point(SCENE, curve)).B


def symmetric_rate(point):
    """Leading growth rate among the modes that keep the mirror symmetry."""
    modes = spectrum(replace(SCENE, B=point.B), state_of(point, SCENE, "W").positions)
    return next(mode.rate.real for mode in modes.in_plane if mode.symmetric)


def test_a_symmetric_mode_is_neutral_at_a_fold(curve):
    """An independent criterion: the leading symmetric rate is zero at the fold, negative on the W, positive beyond."""
    fold = first_fold(curve, down_from_w(curve))
    beyond, before = curve.ahead(fold, 1e-4), curve.ahead(fold, -1e-4)
    assert abs(symmetric_rate(fold)) < 1e-8
    assert symmetric_rate(before) < -1e-5 and symmetric_rate(beyond) > 1e-5


def test_crossing_finds_a_zero_along_the_curve(curve):
    """Where the fiber is a third of its length high: by root finding from either end, and by steady_state there."""

    def measure(point):
        return np.ptp(point.positions[:, 1]) - SCENE.length / 3.0

    low, high = point_at(curve, 400.0), point_at(curve, 500.0)
    found, again = curve.crossing(low, high, measure), curve.crossing(high, low, measure)
    assert abs(measure(found)) < 1e-9
    assert pytest.approx(found.B, rel=1e-10) == again.B
    assert steady_state(found.B).height == pytest.approx(SCENE.length / 3.0, rel=1e-9)


def test_following_goes_through_a_sharp_fold_and_never_back():
    """RPY-overlap: past the W's fold the curve goes on to the W; a step that turned too far used to lead back."""
    curve = SteadyCurve(replace(SCENE, hydrodynamics="RPY-overlap"))
    seed = straight_point(SCENE, curve)
    folds, last = [], seed
    for point in curve.follow(seed):
        if last.tangent[-1] * point.tangent[-1] < 0:
            folds.append(curve.fold(last, point).B)
        last = point
        if not 5.0 < point.B < 1e5:
            break
    assert last.B > 1e5
    assert folds == pytest.approx([60503.447, 6973.2106], rel=1e-7)


def test_a_state_beside_a_fold_is_on_its_own_branch(curve):
    """One part in 1e7 above the fold, W and middle section differ, and each is found from its own side."""
    fold = first_fold(curve, down_from_w(curve))
    sides = [curve.ahead(fold, side) for side in (-1e-3, 1e-3)]
    near = [curve.at(fold.B * (1 + 1e-7), fold, side) for side in sides]
    assert symmetric_rate(near[0]) < 0 < symmetric_rate(near[1])


def test_every_state_between_two_points_is_found():
    """101 stiff beads bend in a narrow range about ℬ = 300, where Newton from afar goes astray."""
    scene = Scene(100.0, 0.0, 101)
    curve = SteadyCurve(scene)
    last = straight_point(scene, curve)
    for point in curve.follow(last):
        wanted = np.geomspace(last.B, point.B, 7)[1:-1]
        found = [curve.at(float(B), last, point).B for B in wanted]
        np.testing.assert_allclose(found, wanted, rtol=1e-12)
        last = point
        if last.B > 500.0:
            break
