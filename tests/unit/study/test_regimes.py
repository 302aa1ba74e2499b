"""Regimes: measured exactly on motions whose answer is known, and named as the source names those of the study."""

import numpy as np
import pandas as pd
import pytest

from sedfiber import Scene, simulate
from sedfiber.commands.cli import main
from sedfiber.core.errors import InputError
from sedfiber.study.regimes import measure_motion

N = 31
BOND_PLACES = (np.arange(N - 1) - 0.5 * (N - 2)) / N  # s of each bond's middle, in L
TIMES = np.linspace(0.0, 1.0, 201)


def fibers(inclinations):
    """Positions (T, N, 3) of fibers with the given inclinations of their bonds, (T, N − 1)."""
    bonds = 2.0 * np.stack([np.cos(inclinations), np.sin(inclinations), np.zeros_like(inclinations)], axis=-1)
    return np.concatenate([np.zeros((len(bonds), 1, 3)), np.cumsum(bonds, axis=1)], axis=1)


def hairpins(apexes, half=1.7):
    """A fold that turns the tangent from −half to half, sharp compared with L, at each of the places ``apexes``."""
    return half * np.tanh((BOND_PLACES - np.asarray(apexes)[:, None]) / 0.04)


def test_a_straight_line_that_turns_only_rotates():
    motion = measure_motion(fibers(np.outer(0.8 * (1.0 - TIMES), np.ones(N - 1))))
    assert motion.turned == pytest.approx(0.8)
    assert motion.turned_whole == pytest.approx(0.8)
    assert motion.turned_sliding == pytest.approx(0.0, abs=1e-12)
    assert motion.bend_max == pytest.approx(0.0, abs=1e-12)
    assert motion.regime == "rotation"


def test_more_than_a_half_turn_is_measured_whole():
    """Inclinations jump by 2π in arctan2, not in the measure."""
    motion = measure_motion(fibers(np.outer(5.0 * TIMES, np.ones(N - 1))))
    assert motion.turned == pytest.approx(-5.0)


def test_an_arc_that_closes_evenly_only_bends():
    motion = measure_motion(fibers(np.outer(TIMES, 2.0 * BOND_PLACES)))
    assert motion.bend_terminal == motion.bend_max == pytest.approx(2.0 * (N - 2) / N)
    assert motion.turned_whole == pytest.approx(0.0, abs=1e-12)
    assert motion.apex_farthest == pytest.approx(0.0, abs=1e-12)
    assert motion.regime == "bending"


def test_the_greatest_bend_may_be_on_the_way():
    motion = measure_motion(fibers(np.outer(np.sin(0.75 * np.pi * TIMES), 2.0 * BOND_PLACES)))
    assert motion.bend_max == pytest.approx(2.0 * (N - 2) / N, rel=1e-3)
    assert motion.bend_terminal == pytest.approx(np.sqrt(0.5) * motion.bend_max, rel=1e-3)


@pytest.mark.parametrize(("half_bend", "regime"), [(0.59, "rotation"), (0.61, "bending")])
def test_rotation_ends_where_each_side_bends_as_far_as_the_fiber_turns(half_bend, regime):
    """A fiber that turns by 0.6 while each of its ends bends by a little less, or more."""
    arc = 2.0 * half_bend * BOND_PLACES * N / (N - 2)
    assert measure_motion(fibers(0.6 * (1.0 - TIMES[:, None]) + np.outer(TIMES, arc))).regime == regime


def test_a_fold_that_slides_turns_the_fiber_by_sliding_alone():
    """Arms at ±1.7 rad, 0.8 L and 0.2 L long, become equal: the mean over N − 1 bonds turns by 1.7 · 0.6 N/(N − 1)."""
    motion = measure_motion(fibers(hairpins(-0.3 * (1.0 - TIMES))))
    assert motion.turned == pytest.approx(1.7 * 0.6 * N / (N - 1), rel=1e-3)
    assert motion.turned_sliding == pytest.approx(motion.turned, rel=5e-3)
    assert motion.apex_farthest == pytest.approx(-0.3, abs=2e-3)
    assert motion.slid_folded == pytest.approx(0.3, abs=2e-3)
    assert motion.regime == "snaking"


def test_a_folded_fiber_that_turns_without_sliding_turns_as_a_whole():
    """Its fold stays off the centre; nothing slides."""
    motion = measure_motion(fibers(hairpins(np.full(len(TIMES), -0.3)) - 0.9 * TIMES[:, None]))
    assert motion.turned_whole == pytest.approx(0.9)
    assert motion.turned_sliding == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("slide", "half", "regime"), [(0.9, 1.7, "bending"), (1.1, 1.7, "snaking"), (3.0, 1.5, "bending")]
)
def test_snaking_needs_a_fold_and_a_slide_of_more_than_a_bond(slide, half, regime):
    """A slide of 0.9 bonds is too little; a bend of 3.0 < π is no fold, however far it slides."""
    motion = measure_motion(fibers(hairpins(-slide / N * (1.0 - TIMES), half)))
    assert motion.bond == 1.0 / N
    assert motion.regime == regime


def test_place_and_direction_of_the_fall_do_not_matter():
    """Positions moved and mirrored: the same amounts, turned the other way, the apex at the other end."""
    positions = fibers(hairpins(-0.3 * (1.0 - TIMES)))
    one = measure_motion(positions)
    other = measure_motion((positions * [-1.0, 1.0, 1.0])[:, ::-1] + [5.0, -90.0, 0.0])
    assert other.turned == pytest.approx(-one.turned)
    assert other.turned_sliding == pytest.approx(-one.turned_sliding)
    assert other.apex_farthest == pytest.approx(-one.apex_farthest)
    assert other.regime == one.regime


@pytest.mark.parametrize(("B", "regime"), [(100, "rotation"), (1000, "bending"), (10000, "snaking")])
def test_the_study_rotates_at_low_bends_at_moderate_and_snakes_at_high_numbers(B, regime):
    """The paper's statement at θ₀ = π/4. Whatever the regime, the mean tangent turns by θ₀."""
    motion = measure_motion(simulate(Scene(B, np.pi / 4)).positions)
    assert motion.regime == regime
    assert motion.turned == pytest.approx(np.pi / 4, abs=0.01)


@pytest.mark.parametrize("shape", [(1, 5, 3), (3, 2, 3)])
def test_too_few_samples_or_beads_are_refused(shape):
    with pytest.raises(InputError, match="positions: ") as caught:
        measure_motion(np.zeros(shape))
    assert "\n" not in str(caught.value)


def test_the_table_has_a_row_for_each_fall(tmp_path):
    """Of every split, with the numbers that were measured."""
    words = ["--n-beads", "7", "--B", "1000"]
    assert main(["simulate", *words, "--angle-index", "12", "-o", str(tmp_path / "run.parquet")]) == 0
    shapes = ["--settings", '{"n_beads": 7, "B": [1000]}', "-o", str(tmp_path / "shapes.parquet")]
    assert main(["solve_terminal_shapes", *shapes]) == 0
    splits = []
    for label in ("train", "A"):
        data = tmp_path / f"{label}.parquet"
        settings = ["--settings", f'{{"split": "{label}"}}', "-o", str(data)]
        assert main(["aggregate_dataset", str(tmp_path / "run.parquet"), *settings]) == 0
        splits += [str(data), str(tmp_path / "shapes.parquet")]
    assert main(["tabulate_regimes", *splits, "-o", str(tmp_path / "regimes.csv")]) == 0
    table = pd.read_csv(tmp_path / "regimes.csv")
    assert table["split"].tolist() == ["train", "A"]
    assert (table["B"] == 1000).all() and (table["angle_index"] == 12).all()
    expected = measure_motion(simulate(Scene(1000, np.pi / 4, 7)).positions)
    assert table["turned"].tolist() == pytest.approx([expected.turned] * 2)
    assert table["regime"].tolist() == [expected.regime] * 2
