"""An effect that a scene does not list is never made, called or imported, allocates nothing and changes no bit."""

import importlib
import inspect
import json
import subprocess
import sys

import numpy as np
import pytest

from sedfiber import Numerics, Scene, simulate
from sedfiber.physics.integrators import StochasticMidpoint
from sedfiber.scene.parts import PARTS

# What the study's scene does not list, and the modules in which it acts.
UNLISTED = {
    "bending": ["physics.curved_bending"],
    "wall": ["physics.wall", "physics.near_wall"],
    "contact": ["physics.contact", "physics.wall_contact"],
    "flow": ["physics.linear_flow", "physics.parabolic_flow", "physics.flow_couple", "physics.couple_flow"],
    "own": ["scene.own_effect"],
}
LISTING = {
    "bending": {"bending": {"curvature": 0.05}},
    "wall": {"wall": {"point": [0, -100, 0]}, "space": "volume"},
    "contact": {"contact": {}},
    "flow": {"flow": {"name": "shear", "rate": 0.01}},
    "own": {"own": [{"file": "own.py", "effect": "Nothing"}]},
    "noise": {"noise": {"peclet": 100.0}},
}
MODULES = [name for names in UNLISTED.values() for name in names]
STUDY = {"B": 1000.0, "theta0": 0.7, "n_beads": 11}
NOTHING = (
    "class Nothing:\n    def force(self, x):\n        return 0.0 * x\n\n    def energy(self, x):\n        return 0.0\n"
)
END = 20.0


def run_process(folder, program, *words):
    """What a program in a process of its own prints as JSON on its last line."""
    said = subprocess.run(
        [sys.executable, "-c", program, *words], cwd=folder, capture_output=True, text=True, timeout=120, check=True
    )
    return json.loads(said.stdout.splitlines()[-1])


def module_of(name):
    """A module of the package, or None where it has not been written."""
    try:
        return importlib.import_module(f"sedfiber.{name}")
    except ModuleNotFoundError:
        return None


@pytest.fixture
def calls(monkeypatch):
    """Counts calls of every method of every class that the study's scene does not list, and of noise's."""
    counts = {}

    def spy(owner, name, function):
        def counted(*words, **options):
            counts[owner.__name__] = counts.get(owner.__name__, 0) + 1
            return function(*words, **options)

        monkeypatch.setattr(owner, name, counted)

    modules = [module for module in map(module_of, MODULES) if module is not None]
    classes = [one for module in modules for _, one in inspect.getmembers(module, inspect.isclass)]
    for owner in {one for one in classes if one.__module__ in {module.__name__ for module in modules}}:
        if not getattr(owner, "_is_protocol", False):
            for name, function in inspect.getmembers(owner, inspect.isfunction):
                if name in vars(owner):
                    spy(owner, name, function)
    for name in ("__init__", "states"):
        spy(StochasticMidpoint, name, getattr(StochasticMidpoint, name))
    monkeypatch.setattr(
        "sedfiber.scene.start._displacement", lambda *words: counts.setdefault("disturbance", 1) * np.nan
    )
    return counts


def test_nothing_unlisted_is_called(calls):
    """A whole run of the study's scene, its checks and its audit: not one call."""
    simulate(Scene(**STUDY), t_end=END)
    assert calls == {}


@pytest.mark.parametrize(
    ("key", "called"),
    [
        ("bending", {"CurvedBending"}),
        ("wall", {"WallCorrection", "NearWall"}),
        ("contact", {"Contact"}),
        ("flow", {"LinearFlow", "FlowCouple"}),
        ("noise", {"StochasticMidpoint"}),
    ],
)
def test_what_is_listed_is_called_and_nothing_else(calls, key, called):
    """One more part calls its own classes alone (the couple's own flow goes with the couple): the spies do see."""
    simulate(Scene(**(STUDY | LISTING[key])), t_end=1.0)
    assert set(calls) - {"CoupleFlow"} == called


IMPORTS = """
import json, sys
from sedfiber import Scene
from sedfiber.commands.cli import main
from sedfiber.scene.assembly import assemble
study, listing = json.loads(sys.argv[1]), json.loads(sys.argv[2])
def loaded():
    return {name.removeprefix("sedfiber.") for name in sys.modules if name.startswith("sedfiber.")}
words = [f"--{key.replace('_', '-')}={value}" for key, value in study.items()]
status = main(["simulate", *words, "--t-end=2", "-o", "x.parquet"])
before = loaded()
found = {"study": sorted(before), "status": status}
for key, values in listing.items():
    assemble(Scene(**(study | values)))
    found[key], before = sorted(loaded() - before), loaded()
print(json.dumps(found))
"""


def test_nothing_unlisted_is_imported(tmp_path):
    """A process that simulates the study's scene holds none of these modules; each part brings its own alone."""
    (tmp_path / "own.py").write_text(NOTHING)
    listing = {key: LISTING[key] for key in UNLISTED}
    found = run_process(tmp_path, IMPORTS, json.dumps(STUDY), json.dumps(listing))
    assert found["status"] == 0
    assert not set(MODULES) & set(found["study"])
    for key, modules in UNLISTED.items():
        assert set() < set(found[key]) <= set(modules)


@pytest.fixture(scope="module")
def study():
    """The study's scene as short as it can be written."""
    return simulate(Scene(STUDY["B"], STUDY["theta0"], STUDY["n_beads"]), t_end=END)


@pytest.mark.parametrize("nothing", [None, "none"])
@pytest.mark.parametrize("key", ["wall", "flow", "contact", "noise", "disturbance", "fibers", "own", "shape"])
def test_leaving_a_part_out_in_words_changes_no_bit(study, key, nothing):
    """Each key set to none or null: the same positions, bit for bit, and the same record of the run."""
    run = simulate(Scene(**STUDY, **{key: nothing}), t_end=END)
    assert run.positions.tobytes() == study.positions.tobytes()
    assert run.metadata == study.metadata


def test_all_parts_are_left_out_or_spelled_out(study):
    """All at once, the three parts of the study with their defaults, from a dictionary: still no bit."""
    spelled = {"gravity": {"direction": [0, -1, 0]}, "stretching": {"factor": 1.0}, "bending": {"curvature": 0.0}}
    values = STUDY | {part.key: "none" for part in PARTS} | spelled
    run = simulate(Scene.from_dict(values | {"depth": None}), Numerics(), END)
    assert run.positions.tobytes() == study.positions.tobytes()
    assert run.metadata == study.metadata


@pytest.mark.parametrize(
    ("values", "bound"),
    [
        ({"contact": {"reach": 2.01}}, 0.0),  # beads keep 1.78a apart
        ({"fibers": [{}]}, 0.0),
        ({"fibers": [{"theta0": 0.7, "B": 1000, "place": [0, 0]}]}, 0.0),
        ({"shape": "rest"}, 0.0),
        ({"disturbance": {"amplitude": 0.0, "direction": "in-plane"}}, 0.0),
        ({"depth": 1e6}, 0.0),
        ({"own": [{"file": "own.py", "effect": "Nothing"}]}, 1e-10),
    ],
    ids=["contact", "one fiber", "one fiber in full", "rest shape", "disturbance", "depth", "own"],
)
def test_a_part_that_does_nothing_changes_nothing(study, tmp_path, monkeypatch, values, bound):
    """Listed but idle: not a bit differs; but an effect of one's own makes the system
    look at laboratory positions, which are rounded: 4e-14 a when this was written.
    """
    (tmp_path / "own.py").write_text(NOTHING)
    monkeypatch.chdir(tmp_path)
    run = simulate(Scene(**STUDY, **values), t_end=END)
    assert np.abs(run.positions - study.positions).max() <= bound


ALLOCATIONS = """
import gc, importlib, json, sys, tracemalloc
from sedfiber import Scene
from sedfiber.scene.assembly import assemble
study, listing, names = map(json.loads, sys.argv[1:])
def most(system):
    y = system.to_state(Scene(**study, space=["plane", "volume"][system.shape[1] - 2]).start())
    peaks = []
    for call in (system.rhs, system.jacobian):
        for _ in range(3):
            call(0.0, y)
        gc.collect(); gc.disable()
        tracemalloc.start()
        call(0.0, y)
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        call(0.0, y)
        after, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop(); gc.enable()
        peaks += [peak - before, after - before]
    return peaks
system = assemble(Scene(**study))
found = {"alone": most(system), "again": most(system)}
for name in names:
    importlib.import_module("sedfiber." + name)
parts = {key: assemble(Scene(**(study | values))) for key, values in listing.items()}
found |= {"beside": most(system), "fresh": most(assemble(Scene(**study)))}
print(json.dumps(found | {key: most(part) for key, part in parts.items()}))
"""


def test_nothing_unlisted_allocates(tmp_path):
    """Peak and lasting bytes of a right-hand side and a Jacobian: the same, to the byte, before and after the code
    of all other parts is imported and put to work in systems of its own; a listed part does show in the count.
    """
    (tmp_path / "own.py").write_text(NOTHING)
    listing = {key: LISTING[key] for key in ("flow", "own", "contact")}
    names = [name for name in MODULES if module_of(name) is not None]
    found = run_process(tmp_path, ALLOCATIONS, *map(json.dumps, (STUDY, listing, names)))
    assert found["alone"] == found["again"] == found["beside"] == found["fresh"]
    rhs, _, jacobian, _ = found["alone"]
    assert found["flow"][0] > rhs and found["own"][0] > rhs
    assert found["contact"][2] > jacobian
