"""Effects that a user brings: those of the page about them, and what is done with one that is wrong."""

import hashlib
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import reference
from problems import bent_chain
from sedfiber import InputError, Numerics, Scene, read_scene, read_trajectory, simulate
from sedfiber.commands.cli import main
from sedfiber.scene.assembly import assemble
from sedfiber.scene.own_effect import OwnFlow, OwnForce, load_own
from sedfiber.scene.parts import Own

PAGE = Path(__file__).parents[3] / "docs" / "own_effect.md"
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
FILES = {body.splitlines()[0].removeprefix("# "): body for kind, body in BLOCKS if kind in ("python", "yaml")}
COMMANDS = [line.removeprefix("$ ") for kind, body in BLOCKS if kind == "console"
            for line in body.splitlines() if line.startswith("$ ")]  # fmt: skip
ANALYTIC = """
import numpy as np

class Weight:
    def force(self, x):
        return np.tile([0.0, -1.0, 0.0][: x.shape[1]], (len(x), 1))

    def energy(self, x):
        return x[:, 1].sum()

class Well:  # F = −k |x|² x, bead by bead
    def __init__(self, k=0.01):
        self.k = k

    def force(self, x):
        return -self.k * (x * x).sum(axis=1, keepdims=True) * x

class Drift(Well):
    velocity, force = Well.force, None

class WrongEnergy(Weight):
    def energy(self, x):
        return 1.1 * x[:, 1].sum()
"""
WRONG = """
from __future__ import annotations
from dataclasses import dataclass
import numpy as np

class Fewer:
    def force(self, x):
        return x[:-1]

class One:
    def velocity(self, x):
        return 1.0

class Nothing:
    def force(self, x):
        x += 1.0

class Nan:
    def force(self, x):
        return x * np.nan

class Later:
    def velocity(self, x):
        return np.where(x < -5.0, np.inf, 0.0)

class RaisesLater:
    def force(self, x):
        raise ValueError("no force\\nat all")

class Text:
    def velocity(self, x):
        return "abc"

class EnergyRaises:
    def force(self, x):
        return 0.0 * x

    def energy(self, x):
        return x[:, 1]

class Both:
    def force(self, x):
        return 0.0 * x

    velocity = force

class Neither:
    forces = velocities = None

class Constant:
    force = 3.0

class Raises:
    def __init__(self, reason="none"):
        raise ValueError(f"no reason\\nbut {reason}")

@dataclass
class Plain:
    stiffness: float = 0.0

    def force(self, x):
        return -self.stiffness * x
"""
SCENE = "B: 100\ntheta0: 0.7\nn_beads: 5\nnumerics: {t_end: 20}\nown:\n- "


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """A folder with the page's files in which its commands have been run, in order."""
    folder = tmp_path_factory.mktemp("page")
    for name, body in FILES.items():
        (folder / name).write_text(body, encoding="utf-8")
    for command in COMMANDS:
        program, *words = command.split()
        argv = [sys.executable, *(["-m", "sedfiber"] if program == "sedfiber" else []), *words]
        subprocess.run(argv, cwd=folder, capture_output=True, timeout=120, check=True)
    return folder


def test_the_trap_carries_the_fiber(page):
    """At the end the spring pulls with the weight of 31 beads and nothing moves: all forces of the NumPy reference
    balance on each bead, with no more than the round-off of the settling left; the fiber hangs upright.
    """
    run, scene = read_trajectory(page / "trap.parquet"), read_scene(page / "trap.yaml")[0]
    x = run.positions[-1, :, :2]
    assert_allclose(x[15], [0.0, -31 / 0.5], rtol=0, atol=1e-5)

    def energy(y):
        return reference.total_energy(y, scene.modulus) + 0.25 * (y[..., 15, :] ** 2).sum(-1)

    assert np.abs(reference.gradient(energy, x)).max() < 1e-5
    assert_allclose(x[::-1] * [-1, 1], x, rtol=0, atol=1e-4)
    assert run.metadata["checks"]["energy_imbalance"] < 1e-7
    assert run.metadata["scene"]["own"] == [{"file": "trap.py", "effect": "Trap", "parameters": {"stiffness": 0.5}}]


def test_a_bead_stays_on_its_streamline(page):
    """ψ is constant along the path of a single bead, and the path starts with the eddy's velocity and goes round."""
    bead, fiber = (read_trajectory(page / f"{name}.parquet") for name in ("bead", "cells"))
    k, x = np.pi / 60, bead.positions[:, 0, :2]
    assert_allclose(np.prod(np.sin(k * x), axis=1), np.sin(10 * k), rtol=0, atol=1e-6)
    start = (x[1] - x[0]) / bead.t[1]
    assert_allclose(start, [0.0, -2 * np.cos(10 * k)], atol=0.05)
    assert np.abs(x - 30).max() < 20 + 1e-4 and np.ptp(x, axis=0).min() > 39
    assert fiber.n_beads == 31 and np.array_equal(fiber.centre[0], [10, 30, 0])


@pytest.mark.parametrize(
    ("effect", "line"),
    [
        ("{file: none.py, effect: Trap}", "own.file: .*none.py' does not exist; give the path of a Python file"),
        ("{file: ., effect: Trap}", "own.file: .* does not exist; give the path of a Python file"),
        (
            "{file: wrong.py, effect: Missing}",
            "own.effect: 'Missing' is not in .*, but Fewer, One, .*; give",
        ),
        ("{file: wrong.py, effect: Raises}", "own: cannot make 'Raises' from .*wrong.py' .ValueError: no reason."),
        ("{file: wrong.py, effect: Plain, parameters: {soft: 1}}", "own: cannot make 'Plain' .*TypeError: .*'soft'"),
        ("{file: broken.py, effect: Any}", "own: cannot make 'Any' from .*broken.py' .SyntaxError: "),
        ("{file: wrong.py, effect: Neither}", r"own.effect: 'Neither' has neither force\(x\) nor velocity\(x\); write"),
        ("{file: wrong.py, effect: Constant}", "own.effect: 'Constant' has neither "),
        ("{file: wrong.py, effect: Fewer}", r"own: Fewer returned shape \(4, 2\); return finite .* \(5, 2\)"),
        ("{file: wrong.py, effect: One}", r"own: One returned shape \(\); "),
        ("{file: wrong.py, effect: Nothing}", r"own: Nothing returned shape \(\); "),
        ("{file: wrong.py, effect: RaisesLater}", "own: RaisesLater failed .ValueError: no force at all.; it is given"),
        ("{file: wrong.py, effect: Text}", "own: Text failed .ValueError: "),
        ("{file: wrong.py, effect: EnergyRaises}", "own: the energy of EnergyRaises failed .TypeError: "),
        ("{file: wrong.py, effect: Both}", r"own.effect: 'Both' has both force\(x\) and velocity\(x\); make it two"),
        ("{file: wrong.py, effect: Nan}", "own: Nan returned a number that is not finite; "),
        ("{file: wrong.py, effect: Later}", "own: Later returned a number that is not finite; "),
        (
            "{file: analytic.py, effect: WrongEnergy}",
            "check failed: energy imbalance 0.0.*, or is an energy.x. of yours",
        ),
    ],
)
def test_wrong_effects_are_one_line(tmp_path, capfd, effect, line):
    """What is wrong is named on one line, at the start or in the middle of a run; no file is written."""
    texts = {"wrong.py": WRONG, "analytic.py": ANALYTIC, "broken.py": "class Any(:\n", "scene.yaml": SCENE + effect}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    assert main(["simulate", str(tmp_path / "scene.yaml"), "-o", str(tmp_path / "x.parquet")]) == 1
    said = capfd.readouterr()
    assert said.out == "" and re.match(f"sedfiber simulate: {line}.*\n$", said.err) and said.err.count("\n") == 1
    assert not (tmp_path / "x.parquet").exists()


@pytest.fixture
def effects(tmp_path):
    """A loader of the classes above, which are in two files."""
    (tmp_path / "analytic.py").write_text(ANALYTIC)
    (tmp_path / "wrong.py").write_text(WRONG)
    return lambda file, effect, **parameters: Own(str(tmp_path / file), effect, parameters)


def test_classes_may_be_dataclasses_with_annotations_as_text(effects):
    """A dataclass looks its module up by name; two scenes may share a file and differ in parameters."""
    one, other = (load_own(effects("wrong.py", "Plain", stiffness=k)) for k in (2.0, 3.0))
    force = np.zeros((1, 2))
    one.add_force(np.ones((1, 2)), force)
    other.add_force(np.ones((1, 2)), force)
    assert_allclose(force, -5.0)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize(("name", "kind"), [("Well", OwnForce), ("Drift", OwnFlow)])
@pytest.mark.parametrize(("distance", "digits"), [(0, 9), (100, 8.5), (1e4, 6.5)])
def test_jacobian_is_close_to_the_analytic_one(effects, name, kind, dim, distance, digits):
    """As many digits as the page says, of the largest entry; added to the corner of a larger matrix."""
    own, x, k = load_own(effects("analytic.py", name)), bent_chain(1, dim=dim) + distance, 0.01
    assert type(own) is kind
    jac = np.ones((x.size + 1, x.size + 1))
    own.add_jacobian(x, jac)
    blocks = -k * ((x * x).sum(axis=1)[:, None, None] * np.eye(dim) + 2 * x[:, :, None] * x[:, None, :])
    expected = np.zeros_like(jac)
    for i, block in enumerate(blocks):
        expected[i * dim : (i + 1) * dim, i * dim : (i + 1) * dim] = block
    assert_allclose(jac - 1.0, expected, rtol=0, atol=10.0**-digits * np.abs(blocks).max())


def test_calls_are_as_many_as_the_page_says(effects):
    """A right-hand side calls the method once, a Jacobian once and twice per coordinate."""
    own = effects("analytic.py", "Well")
    system = assemble(Scene(1000, 0.5, 5, own=[own, effects("analytic.py", "Weight")]))
    counted, calls = system.nonconservative[0], []
    assert [type(part).__name__ for part in (*system.nonconservative, system.forces[-1])] == ["OwnForce"] * 2
    function = counted._function
    counted._function = lambda x: calls.append(1) or function(x)
    y = system.to_state(bent_chain(1, 5, 2))
    for call, count in ((system.rhs, 1), (system.jacobian, 1 + 2 * 10)):
        calls.clear()
        call(0.0, y)
        assert len(calls) == count


@pytest.mark.parametrize("space", ["plane", "volume"])
def test_own_copy_of_gravity_moves_a_fiber_as_gravity_does(effects, space):
    """The same trajectory to 1e-6 a although the Jacobian is one of differences, and the same energy balance."""
    scene = {"B": 1000, "theta0": 0.7, "n_beads": 11, "space": space}
    package = simulate(Scene(**scene), t_end=60)
    own = simulate(Scene(**scene, gravity="none", own=[effects("analytic.py", "Weight")]), t_end=60)
    assert_allclose(own.positions, package.positions, rtol=0, atol=1e-6)
    assert np.ptp(package.centre[:, 1]) > 100
    assert own.metadata["checks"]["energy_imbalance"] < 1e-6


def test_the_record_holds_the_files_checksum(tmp_path):
    """Whoever reads the run can tell which version of the user's code made it."""
    path = tmp_path / "push.py"
    path.write_text("class Push:\n    def force(self, x):\n        return 0.1 + 0.0 * x\n")
    scene = Scene(1000, 0.5, 5, own=[{"file": str(path), "effect": "Push"}])
    facts = simulate(scene, Numerics(t_end=1.0)).metadata
    assert facts["own_sha256"] == {str(path): hashlib.sha256(path.read_bytes()).hexdigest()}
    assert "own_sha256" not in simulate(Scene(1000, 0.5, 5), Numerics(t_end=1.0)).metadata


def test_parameters_that_no_record_can_hold_are_refused_before_the_run():
    """A file's metadata is JSON: a complex number or a NaN would fail only after the work."""
    for value in (1j, float("nan"), object()):
        with pytest.raises(InputError, match=r"^own.parameters: .* \(JSON\)$"):
            Scene(1000, 0.5, 5, own=[{"file": "x.py", "effect": "X", "parameters": {"a": value}}])
