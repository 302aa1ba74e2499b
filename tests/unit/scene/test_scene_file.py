"""Scenes from files and from the command line: the same scene either way, each mistake one line."""

import json
import math

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from scene_examples import BASE, EXAMPLES, LISTS, OWN

from command_line import complaint, status_of
from sedfiber import Numerics, Scene, read_scene, read_trajectory, simulate
from sedfiber.commands.cli import main

PLANAR = {key: st.sampled_from(EXAMPLES[key]) for key in EXAMPLES if key not in ("wall", *LISTS)}
LISTED = {"fibers": st.just([{}, *EXAMPLES["fibers"]]), "own": st.just(OWN), "seed": st.integers(0, 99)}


@given(values=st.fixed_dictionaries({}, optional=PLANAR | LISTED), left_out=st.sets(st.sampled_from([*PLANAR])))
def test_dict_json_and_yaml_give_the_same_scene(tmp_path_factory, values, left_out):
    """Any combination: Scene → dict → JSON → Scene, and a YAML file with the same keys and ``numerics``."""
    values = BASE | values | dict.fromkeys(left_out, "none")
    scene, path = Scene(**values), tmp_path_factory.mktemp("scene") / "scene.yaml"
    assert Scene.from_dict(json.loads(json.dumps(scene.to_dict(), allow_nan=False))) == scene
    own = [{**one, "file": str(path.parent / one["file"])} for one in values.get("own", [])]
    path.write_text(yaml.safe_dump(values | {"numerics": {"rtol": 1e-6, "t_end": 3, "integrator": "BDF"}}))
    assert read_scene(path) == (Scene(**(values | {"own": own})), Numerics("BDF", rtol=1e-6, t_end=3.0))


SCENE = "B: 1000\ntheta0: 0.7\nn_beads: 5\n"


def test_paths_are_looked_for_beside_the_file(tmp_path, monkeypatch):
    """A scene in another folder finds its start shape and names its own effects there; text is UTF-8."""
    (tmp_path / "sub").mkdir()
    np.savetxt(tmp_path / "sub" / "line.csv", [[2.1 * k, 0.5 * k] for k in range(5)], delimiter=",")
    own = "own:\n- {file: trap.py, effect: Trap}\n- {file: /far/off.py, effect: Trap}\n"
    (tmp_path / "sub" / "scene.yaml").write_text(f"# ℬ\n{SCENE}shape: {{file: line.csv}}\n{own}", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    scene, numerics = read_scene("sub/scene.yaml")
    assert scene.shape == tuple((2.1 * k, 0.5 * k, 0.0) for k in range(5)) and numerics == Numerics()
    assert [one.file for one in scene.own] == ["sub/trap.py", "/far/off.py"]


@pytest.mark.parametrize(
    ("text", "start"),
    [
        (None, "scene: cannot read "),
        ("- B\n- theta0\n", "scene: "),
        ("", "scene: "),
        ("B: [1\n", "scene: "),
        ("\x00", "scene: "),
        ("theta0: 1\n", "scene: missing key 'B'"),
        (SCENE + "B: 5\n", "scene: "),
        (SCENE + "shape: {file: none.parquet}\n", "shape.file: input: "),
        (SCENE + "colour: red\n", "scene: unknown key 'colour'; keys are B, theta0, "),
        (SCENE + "1: 2\n", "scene: unknown key 1; keys are B, theta0, "),
        (SCENE + "wall: {pint: 3}\n", "wall: unknown key 'pint'"),
        (SCENE + "flow: {name: shear}\n", "flow.rate: is missing"),
        (SCENE + "shape: {file: none.csv}\n", "shape.file: cannot read "),
        (SCENE + "shape: {file: none.npy}\n", "shape.file: cannot read "),
        (SCENE + "numerics: {colour: 1}\n", "numerics: unknown key 'colour'; keys are integrator, "),
        (SCENE + "t_end: 100\n", "scene: key 't_end' is not allowed here; give it under numerics: { t_end: 100 }"),
        (SCENE + "contact:\n", "contact: is empty; give {} for the defaults, or none"),
        (SCENE + "noise: null\n", "noise: is empty; give {peclet, step}, or none"),
        (SCENE + "fibers:\n", "fibers: is empty; give a list of {B, theta0, place}, or none"),
        (SCENE + "numerics: 3\n", "numerics: 3 is not allowed; give {integrator, "),
        (SCENE + "numerics: {rtol: 0}\n", "rtol: 0 is not allowed"),
        (SCENE + "numerics: {integrator: Euler}\n", "integrator: 'Euler' is not allowed"),
        (SCENE + "noise: {peclet: 1}\nnumerics: {integrator: BDF, t_end: 1}\n", "integrator: BDF with noise"),
        (SCENE + "own:\n- {file: none.py, effect: Trap}\nnumerics: {t_end: 1}\n", "own.file: "),
    ],
)
def test_bad_files_are_one_line_from_the_command(tmp_path, capsys, text, start):
    """What is wrong is named, and nothing is written."""
    path = tmp_path / "bad.yaml"
    if text is not None:
        path.write_text(text)
    line = complaint(capsys, ["simulate", path, "-o", tmp_path / "x.parquet"], 1)
    assert line.startswith(f"sedfiber simulate: {start}")
    assert list(tmp_path.iterdir()) == ([] if text is None else [path])


def test_what_a_scene_has_unless_it_says_otherwise_may_be_empty(tmp_path):
    """The record of a scene without gravity says so by null; from Python None leaves out any part."""
    path = tmp_path / "scene.yaml"
    path.write_text(yaml.safe_dump(Scene(**BASE, gravity=None, contact=None).to_dict()))
    assert read_scene(path)[0] == Scene(**BASE, gravity="none")


def test_options_override_the_file(tmp_path):
    """Each option given replaces the file's value; what is not given stays the file's."""
    path, out = tmp_path / "scene.yaml", tmp_path / "x.parquet"
    path.write_text(SCENE + "gravity: {strength: 0.5}\nseed: 4\nnumerics: {interval: 0.25, t_end: 9, rtol: 1.0e-6}\n")
    options = "--B 500 --angle-index 12 --n-beads 7 --hydrodynamics RPY-overlap --t-end 1 --integrator BDF"
    assert status_of(["simulate", path, *options.split(), "-o", out]) == 0
    run = read_trajectory(out)
    scene = Scene(500, math.pi / 4, 7, hydrodynamics="RPY-overlap", seed=4, gravity={"strength": 0.5})
    assert run.metadata["scene"] == scene.to_dict() | {"start_angle": scene.theta0}
    direct = simulate(scene, Numerics("BDF", rtol=1e-6, interval=0.25), t_end=1)
    assert run.metadata == direct.metadata | {"angle_index": 12} and np.array_equal(run.positions, direct.positions)


def test_options_mend_a_file_that_is_wrong_without_them(tmp_path):
    """`simulate flat.yaml --space volume` where the file alone would be refused: options are merged first."""
    path, out = tmp_path / "flat.yaml", tmp_path / "x.parquet"
    path.write_text("B: 1000\ntheta0: 0.5\nn_beads: 5\nwall: {point: [0, -50, 0]}\nnumerics: {t_end: 1}\n")
    assert main(["simulate", str(path), "-o", str(out)]) == 1
    assert main(["simulate", str(path), "--space", "volume", "-o", str(out)]) == 0
