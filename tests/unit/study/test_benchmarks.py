"""Benchmarks: the yardstick computes the same as the parts, and the tables have what they promise."""

import time

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from problems import bent_chain, system_of
from sedfiber import InputError, Scene
from sedfiber.commands.cli import main
from sedfiber.study import effects_table
from sedfiber.study.costs import fused_study
from sedfiber.study.costs.timing import REPEATS, timed, timed_together


@pytest.mark.parametrize("n_beads", [3, 11, 31])
@pytest.mark.parametrize("seed", range(3))
def test_the_single_kernel_equals_the_parts(n_beads, seed):
    """Right-hand side and Jacobian of the study's scene, written twice, agree to round-off."""
    system = system_of("plane", n_beads=n_beads)
    y = system.to_state(bent_chain(seed, n_beads, 2))
    modulus = 24.0 * n_beads**3 / 1000.0
    for parts, fused in ((system.rhs, fused_study.rhs), (system.jacobian, fused_study.jacobian)):
        expected = parts(0.0, y)
        assert_allclose(fused(y, modulus), expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_times_are_those_of_one_call():
    """A call of 2 ms is timed as such, however many calls make a repeat; ten repeats and a warm-up at least."""
    calls = []

    def call():
        calls.append(1)
        time.sleep(2e-3)

    timing = timed(call)
    assert 2e-3 <= timing.least <= timing.median
    assert timing.spread >= 0.0
    assert len(calls) > REPEATS


def test_calls_are_timed_turn_and_turn_about():
    """The order of the two is a, b, a, b …: a busy moment slows both."""
    order = []
    timed_together([lambda: order.append("a") or time.sleep(3e-3), lambda: order.append("b") or time.sleep(3e-3)])
    assert "".join(order).endswith("ababab")


def test_effects_table_compares_with_the_scene_as_it_is(tmp_path, monkeypatch):
    """The first row is its own measure; what is refused or fails has its reason; contact far away changes nothing."""
    chosen = ("the study's scene", "Oseen", "no bending", "contact", "gravity 1 % stronger")
    monkeypatch.setattr(effects_table, "CHANGES", {name: effects_table.CHANGES[name] for name in chosen})
    path = tmp_path / "effects.csv"
    settings = '{"B": 1000, "angle_index": 12, "n_beads": 11}'
    assert main(["measure_effects", "--settings", settings, "-o", str(path)]) == 0
    table = pd.read_csv(path).set_index("effect")
    first = table.loc["the study's scene"]
    assert first["rhs_ratio"] == first["run_ratio"] == 1.0
    assert first["shape_change_L"] == first["speed_change_percent"] == 0.0
    assert table.loc["Oseen", "status"] == "refused" and "positive definite" in table.loc["Oseen", "reason"]
    assert table.loc["contact", ["shape_change_L", "speed_change_percent"]].tolist() == [0.0, 0.0]
    assert 0 < table.loc["gravity 1 % stronger", "speed_change_percent"] < 2
    assert (table.loc["contact", ["rhs_us", "jacobian_us", "run_s"]].astype(float) > 0).all()


def test_every_change_of_the_effects_table_is_a_scene_or_refused_by_name():
    """A misspelt key would be an unknown key; Oseen is the only one that the scene's rules refuse."""
    refused = []
    for name, change in effects_table.CHANGES.items():
        try:
            Scene.from_dict(Scene(1000, 0.5).to_dict() | change)
        except InputError as error:
            refused.append((name, str(error)))
    assert [name for name, _ in refused] == ["Oseen"]
    assert "unknown" not in refused[0][1]
