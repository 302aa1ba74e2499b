"""Trajectories of the study against another method, other equations, other dimensions."""

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import yaml

import reference
from problems import rms_distance
from sedfiber import Numerics, Scene, simulate
from sedfiber.scene.assembly import assemble

TIGHT = Numerics("Radau", rtol=1e-10, atol=1e-10)  # the default is LSODA at 1e-8
LENGTH = 62.0

# Spread over every ℬ of the study and over the angles; (100, 22) is the stiffest run and
# (10000, 0) the most sensitive.
RUNS = [
    *[(100, 0), (100, 9), (100, 22), (150, 5), (150, 21), (200, 4), (200, 15), (300, 11), (400, 2), (400, 20)],
    *[(700, 7), (700, 17), (1000, 0), (1000, 11), (1500, 3), (1500, 19), (2000, 6), (2000, 22), (3000, 13)],
    *[(4000, 0), (4000, 14), (7000, 1), (7000, 21), (10000, 0), (10000, 11), (10000, 22)],
]


def scene_of(B, k):
    """The study's scene at angle index ``k``."""
    return Scene(B, k * math.pi / 48)


@cache
def default_run(B, k):
    """The trajectory as the study makes it."""
    return simulate(scene_of(B, k))


def test_runs_are_the_studys():
    """Every pair checked below is one of the 227, and there are at least 24 of them."""
    study = yaml.safe_load((Path(__file__).parents[2] / "config.yaml").read_text())["study"]
    pairs = {(B, k) for split in study.values() for B in split["B"] for k in split["angle_index"]}
    assert len(pairs) == 227
    assert set(RUNS) <= pairs
    assert len(set(RUNS)) >= 24
    assert {B for B, _ in RUNS} == {B for B, _ in pairs}


@pytest.mark.parametrize(("B", "k"), RUNS)
def test_default_agrees_with_radau_at_a_hundredth_of_the_tolerance(B, k):
    """Bead positions in the laboratory, rms over beads, agree to 1e-4 L at all times (issue 2 §4)."""
    run = default_run(B, k)
    check = simulate(scene_of(B, k), TIGHT, t_end=run.t[-1])
    assert np.array_equal(check.t, run.t)
    assert rms_distance(run.positions, check.positions, LENGTH).max() < 1e-4
    assert run.settling_time == pytest.approx(check.settling_time, abs=0.01)


def test_whole_fall_agrees_with_equations_written_twice():
    """The NumPy model in absolute coordinates (tests/reference.py) gives the same history to 1e-6 L."""
    run, scene = default_run(1000, 11), scene_of(1000, 11)
    start, jacobian = scene.start(), assemble(scene).velocity_jacobian
    other = reference.integrate(start, scene.modulus, run.t, 1e-10, jacobian)
    assert rms_distance(run.positions[..., :2], other, LENGTH).max() < 1e-6


def test_planar_scene_equals_spatial_scene():
    """The same fall in the plane and in volume at ℬ = 1000: z stays exactly zero, x and y agree to 1e-7 L."""
    plane = simulate(Scene(1000, 0.7854))
    volume = simulate(Scene(1000, 0.7854, space="volume"))
    assert not volume.positions[..., 2].any()
    assert np.array_equal(plane.t, volume.t)
    assert rms_distance(plane.positions, volume.positions, LENGTH).max() < 1e-7


@pytest.mark.parametrize("integrator", ["BDF", "Radau"])
def test_tilted_horizontal_start_has_one_history(integrator):
    """With the study's tilt, θ₀ = 0 at ℬ = 10000 leaves the symmetric shape by the tilt, not by round-off:
    three methods agree to 1e-3 L at all times (DESIGN §1).
    """
    run = default_run(10000, 0)
    other = simulate(scene_of(10000, 0), Numerics(integrator), t_end=run.t[-1])
    assert rms_distance(run.positions, other.positions, LENGTH).max() < 1e-3


def test_opposite_tilts_are_mirror_images():
    """The sign of the tilt picks left or right and nothing else."""
    seeds = {math.copysign(1, Scene(2000, 0.0, seed=seed).start_angle): seed for seed in range(10)}
    runs = [simulate(Scene(2000, 0.0, seed=seeds[sign]), t_end=200.0) for sign in (1.0, -1.0)]
    mirrored = runs[1].positions[:, ::-1] * np.array([-1.0, 1.0, 1.0])
    assert rms_distance(runs[0].positions, mirrored, LENGTH).max() < 1e-6


@pytest.mark.parametrize("k", [5, 15])
def test_mirrored_start_is_a_mirrored_fall(k):
    """θ₀ → −θ₀ with the beads numbered from the other end is the image in x → −x, sample by sample."""
    runs = [simulate(Scene(1000, sign * k * math.pi / 48), t_end=100.0) for sign in (1, -1)]
    mirrored = runs[1].positions[:, ::-1] * np.array([-1.0, 1.0, 1.0])
    assert rms_distance(runs[0].positions, mirrored, LENGTH).max() < 1e-7
