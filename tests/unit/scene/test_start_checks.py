"""Starts that a user did not mean are refused, and what is said of them helps."""

import math

import numpy as np
import pytest

from sedfiber import InputError, NumericalError, Numerics, Scene, simulate

CONTACT = {"contact": {}, "hydrodynamics": "RPY-overlap"}
STRAIGHT = np.column_stack([2.0 * np.arange(7), np.zeros(7)])


@pytest.mark.parametrize(
    ("space", "other"),
    [
        ("plane", {"place": [4, 0.5], "theta0": 1.0}),
        ("plane", {"place": [1, 0], "theta0": math.pi / 2}),  # between beads: as far apart as crossed ones come
        ("volume", {"place": [0, 0.2, 0.1]}),
    ],
)
def test_fibers_that_start_crossed_are_refused_with_contact(space, other):
    """It would hold them together."""
    with pytest.raises(InputError, match=r"^contact: beads \d+ and \d+ are .* a apart at the start"):
        Scene(1000, 0.0, 15, space, fibers=[{}, other], tilt=0.0, **CONTACT)


def test_fibers_that_start_apart_or_without_contact_are_not():
    """Touching ones, and crossed ones that nothing keeps from passing through each other."""
    Scene(1000, 0.0, 15, fibers=[{}, {"place": [0, 2]}], tilt=0.0, **CONTACT)
    Scene(1000, 0.0, 15, fibers=[{}, {"place": [1, 0], "theta0": math.pi / 2}], tilt=0.0, hydrodynamics="RPY-overlap")


@pytest.mark.parametrize("factor", [0.1, 0.7, 1.5, 31.0])
def test_a_shape_in_another_unit_is_refused(factor):
    """All its bonds are too short, or all too long."""
    with pytest.raises(InputError, match=r"^shape: bonds are .*; give positions in bead radii a"):
        Scene(1000, 0.3, 7, hydrodynamics="RPY-overlap", shape=factor * STRAIGHT)


def test_strained_bonds_are_no_other_unit():
    """Some of them, all of them by little, or springs that are not there."""
    stretched = STRAIGHT.copy()
    stretched[4:, 0] += 1.5
    Scene(1000, 0.3, 7, shape=stretched)
    Scene(1000, 0.3, 7, shape=1.2 * STRAIGHT)
    Scene(1000, 0.3, 7, shape=1.5 * STRAIGHT, stretching=None)


@pytest.mark.parametrize("theta0", [math.pi / 2, -math.pi / 2])
def test_a_vertical_fiber_is_called_one(theta0):
    """No tilt helps it, for that replaces θ₀ = 0 alone."""
    with pytest.raises(NumericalError, match="a vertical fiber falls along its axis: give another theta0, or --t-end"):
        simulate(Scene(1000, theta0, 7), Numerics(max_time=1000))


def test_a_csv_file_with_a_header_is_answered_with_the_format(tmp_path):
    (tmp_path / "shape.csv").write_text("x,y\n0,0\n2,0\n4,0\n")
    with pytest.raises(InputError, match="a row of 2 or 3 numbers for each bead, with commas and without a header"):
        Scene(1000, 0.3, 3, shape={"file": tmp_path / "shape.csv"})


def test_rows_are_counted_from_one():
    with pytest.raises(InputError, match=r"^shape: row 2, \[2.0, nan\], is not allowed; give "):
        Scene(1000, 0.3, 3, shape=[[0, 0], [2, math.nan], [4, 0]])
