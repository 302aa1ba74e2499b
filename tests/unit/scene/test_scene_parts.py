"""The parts a scene lists: read from plain values, from files, from the command line; refused by name."""

import json
import math
import re

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from command_line import complaint, status_of
from sedfiber import InputError, Numerics, Scene, read_scene, read_trajectory, simulate, write_trajectory
from sedfiber.commands.cli import main
from sedfiber.physics.curved_bending import rest_arc
from sedfiber.scene.parts import PARTS

BASE = {"B": 1000.0, "theta0": 0.7, "n_beads": 5}
WALL = {"point": [0.0, -50.0, 0.0], "normal": [0.6, 0.8, 0.0]}
OWN = [{"file": "trap.py", "effect": "Trap", "parameters": {"stiffness": 0.5}}]
# Every part with all its parameters; lists hold several of one part.
EXAMPLES = {
    "gravity": [{"direction": [0.6, -0.8, 0.0], "strength": 2.0}],
    "stretching": [{"factor": 3.0}],
    "bending": [{"curvature": 0.05}],
    "wall": [WALL],
    "flow": [
        {"name": "shear", "rate": 0.1, "couple": False},
        {"name": "parabolic", "peak": 2.0, "half_width": 30.0, "couple": True},
        {"gradient": [[0.1, 0.2, 0.0], [0.0, -0.1, 0.0], [0.0, 0.0, 0.0]], "couple": True},
    ],
    "contact": [{"strength": 5.0, "reach": 2.5}],
    "noise": [{"peclet": 10.0, "step": 0.05}],
    "disturbance": [{"amplitude": 0.1, "direction": "in-plane"}],
    "fibers": [{"B": 500.0, "theta0": -0.2, "place": [1.0, 30.0, 0.0]}],
    "own": OWN,
}
LISTS = ("fibers", "own")


def refusal(**values):
    """The one line with which a scene is refused."""
    with pytest.raises(InputError) as error:
        Scene(**(BASE | values))
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.key)
def test_every_part_is_read_from_plain_values(part):
    """From a mapping, from what it writes, from itself; None and "none" leave it out, in a scene too."""
    for example in EXAMPLES[part.key]:
        read = part.read(example)
        assert read == part(**example) == part.read(read) == part.read(read.to_dict())
        assert read.to_dict() == json.loads(json.dumps(read.to_dict())) == example
    empty = () if part.key in LISTS else None
    for nothing in (None, "none"):
        assert part.read(nothing) is None
        assert getattr(Scene(**BASE, **{part.key: nothing}), part.key) == empty


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.key)
def test_unknown_keys_and_what_is_no_mapping_are_refused(part):
    """One line with the part's key and the keys it has; parts of which there are several are lists, without none."""
    for wrong, start in (
        ({"colour": 3}, f"{part.key}: unknown key 'colour'; keys are "),
        (3, f"{part.key}: 3 is not allowed; give none or {{"),
    ):
        line = refusal(**{part.key: [wrong] if part.key in LISTS else wrong})
        assert line.startswith(start)
        assert all(name in line for name in part.names())
    if part.key in LISTS:
        assert refusal(**{part.key: EXAMPLES[part.key][0]}).startswith(f"{part.key}: {{")
        assert len(getattr(Scene(**BASE, **{part.key: [None, EXAMPLES[part.key][0], "none"]}), part.key)) == 1


NAN, INF, VECTOR = float("nan"), float("inf"), "a list of two or three finite numbers"
POSITIVE = "a finite number above 0"
WRONG = {  # what is allowed, and what is not
    "gravity.direction": (VECTOR, [[0, -1, 0, 0], "down", 5, [1], [0, NAN], [0, INF], [0, "x"], [0, None], [0, True]]),
    "gravity.strength": (POSITIVE, [0, -1, NAN, "heavy", None]),
    "stretching.factor": (POSITIVE, [0, INF]),
    "bending.curvature": ("a number from -1 to 1", [1.5, NAN, "bent"]),
    "wall.point": (VECTOR, [[1], "low"]),
    "wall.normal": ("a direction that is not zero", [[0, 0, 0]]),
    "flow.name": ("one of shear, extension, rotation, parabolic", ["Shear", ["shear"], 3]),
    "flow.rate": ("a finite number", [NAN, "fast", True]),
    "flow.couple": ("true or false", [1, "yes", None]),
    "contact.strength": (POSITIVE, [0, "x"]),
    "contact.reach": ("a number from 2.01 to 100", [2.0, 1e3, NAN]),
    "noise.peclet": (POSITIVE, [0, -1, INF]),
    "noise.step": (POSITIVE, [0, -1, INF]),
    "disturbance.amplitude": ("a number from 0 to 0.5", [-0.1, 0.6, NAN]),
    "disturbance.direction": ("one of in-plane, out-of-plane", ["up"]),
    "fibers.B": (POSITIVE, [0, "soft"]),
    "fibers.theta0": ("radians between -π and π", [9, NAN]),
    "fibers.place": (VECTOR, [3]),
    "own.file": ("text", [3, None, ["a"]]),
    "own.effect": ("text", [3, None, ["a"]]),
    "own.parameters": ("a mapping of names to values", [[1], 3, 0, ""]),
}


@pytest.mark.parametrize(("name", "value"), [(name, value) for name, (_, values) in WRONG.items() for value in values])
def test_wrong_values_are_refused_by_name(name, value):
    """One line: part.key, the value, what is allowed."""
    key, parameter = name.split(".")
    part = EXAMPLES[key][0] | {parameter: value}
    line = refusal(**{key: [part] if key in LISTS else part})
    assert line.startswith(f"{name}: ") and f" is not allowed; give {WRONG[name][0]}" in line


CLOSE = {"theta0": math.pi / 2, "fibers": [{}, {"place": [1.0, 0.0]}]}


@pytest.mark.parametrize(
    ("values", "start"),
    [
        ({"wall": {}}, "wall: missing key 'point'"),
        ({"noise": {"step": 1}}, "noise: missing key 'peclet'"),
        ({"disturbance": {"direction": "in-plane"}}, "disturbance: missing key 'amplitude'"),
        ({"own": [{"file": "x.py"}]}, "own: missing key 'effect'"),
        (
            {"flow": {"rate": 1}},
            "flow.name: is missing; give {name: shear, extension, rotation, rate: …}, "
            "{name: parabolic, peak: …, half_width: …} or {gradient: …}, and couple if you like",
        ),
        ({"flow": {"name": "shear"}}, "flow.rate: is missing; give {name: shear, rate: …}, and couple"),
        ({"flow": {"name": "Shear"}}, "flow.name: 'Shear' is not allowed; give one of shear, "),
        (
            {"flow": {"name": "parabolic", "peak": 1}},
            "flow.half_width: is missing; give {name: parabolic, peak: …, half_width: …}, and couple",
        ),
        (
            {"flow": {"name": "shear", "rate": 1, "peak": 1}},
            "flow.peak: 1 does not belong to this flow; give {name: shear, rate: …}",
        ),
        (
            {"flow": {"name": "shear", "gradient": [[0, 1], [0, 0]]}},
            "flow.name: 'shear' does not belong to this flow; give {gradient: …}, and couple",
        ),
        *[
            ({"flow": {"gradient": g}}, "flow.gradient: ")
            for g in (np.eye(2), np.eye(5), 5, [[1, 2], [3]], [[1]], [["a", 0], [0, 0]], [[NAN, 0], [0, 0]], ["a", "b"])
        ],
        ({"flow": {"gradient": [[1, 0], [0, 1]]}}, "flow.gradient: [[1, 0], [0, 1]] is not allowed"),
        ({"wall": WALL}, "wall: cuts the plane"),
        ({"gravity": {"direction": [0, 0, -1]}}, "gravity.direction: points out of the plane"),
        ({"flow": {"gradient": [[0, 0, 1], [0, 0, 0], [0, 0, 0]]}}, "flow.gradient: leaves the plane"),
        ({"flow": {"gradient": [[0, 0, 0], [0, 0, 0], [0, 1, 0]]}}, "flow.gradient: leaves the plane"),
        ({"fibers": [{}, {"place": [0, 0, 9]}]}, "fibers.place: out of the plane"),
        ({"disturbance": {"amplitude": 0.1}}, "disturbance.direction: out-of-plane"),
        ({"shape": [[2 * k, 0, k] for k in range(5)]}, "shape: leaves the plane"),
        ({"wall": WALL, "space": "volume", "hydrodynamics": "none"}, "hydrodynamics: none near a wall"),
        ({"wall": WALL, "space": "volume", "hydrodynamics": "Oseen"}, "hydrodynamics: Oseen near a wall"),
        ({"wall": {"point": [0, -3.0, 0]}, "space": "volume"}, "wall: bead 0 starts 0.4231 a above it"),
        ({"wall": {"point": [0, 5, 0]}, "space": "volume"}, "wall: bead 0 starts -7.577 a above it"),
        *[
            ({"wall": WALL, "space": "volume", "flow": flow}, "flow: is ")
            for flow in (
                {"name": "extension", "rate": 0.1},
                {"name": "shear", "rate": 1e-6},
                {"name": "parabolic", "peak": 1.0, "half_width": 50.0},
                {"gradient": [[0, 0, 1], [0, 0, 0], [0, 0, 0]]},
            )
        ],
        ({"bending": {"curvature": 0.1}, "space": "volume"}, "bending.curvature: a straight start in volume"),
        ({"fibers": [{}, {"theta0": -0.7}]}, "start: beads 2 and 7 are in one place"),
        (CLOSE, "hydrodynamics: plain RPY is not positive definite for beads 0 and 5, 1 a apart"),
        (CLOSE | {"hydrodynamics": "Oseen"}, "hydrodynamics: Oseen with beads that overlap (0 and 5 are 1 a apart)"),
        ({"hydrodynamics": "Oseen", "n_beads": 31}, "hydrodynamics: Oseen is not positive definite for these 31"),
    ],
)
def test_what_is_missing_or_does_not_go_together_is_refused(values, start):
    """Keys that are missing or of another flow, a fluid that is compressed, parts that make no sense together."""
    assert refusal(**values).startswith(start)


@pytest.mark.parametrize(
    "values",
    [
        CLOSE | {"hydrodynamics": "RPY-overlap"},
        CLOSE | {"fibers": [{}, {"place": [1.4, 0.0]}]},
        {"hydrodynamics": "Oseen"},
        {"bending": {"curvature": 0.1}},
        {"bending": {"curvature": 0.1}, "space": "volume", "shape": "rest"},
        {"wall": {"point": np.array([0, -4.0, 0])}, "space": "volume", "flow": {"gradient": np.zeros((3, 3))}},
        {
            "wall": {"point": [0, -50, 0]},
            "space": "volume",
            "flow": {"name": "parabolic", "peak": 1, "half_width": 50},
        },
        {
            "wall": {"point": [7, 0, 1]},
            "fibers": [{"place": [0, 9]}],
            "space": "volume",
            "flow": {"name": "shear", "rate": 1},
        },
        {
            "wall": {"point": [4, -3, 1], "normal": [0.6, 0.8, 0]},
            "fibers": [{"place": [0, 20]}],
            "space": "volume",
            "flow": {"gradient": [[0.8 * 0.6, 0.8 * 0.8], [-0.6 * 0.6, -0.6 * 0.8]]},
        },
        {"disturbance": {"amplitude": 0.1}, "gravity": {"direction": [0, 0, -1]}, "space": "volume"},
    ],
)
def test_what_is_next_to_a_refusal_is_allowed(values):
    """The advice of each line above leads to a scene."""
    Scene(**(BASE | values))


@pytest.mark.parametrize(
    ("values", "how", "start"),
    [
        ({"noise": {"peclet": 1}}, {"integrator": "BDF"}, "integrator: BDF with noise is not allowed"),
        ({}, {"integrator": "stochastic-midpoint"}, "integrator: stochastic-midpoint without noise is not allowed"),
        ({"noise": {"peclet": 1, "step": 0.3}}, {}, "noise.step: 0.3 does not divide the sampling interval 0.5"),
        ({"noise": {"peclet": 1, "step": 1.0}}, {}, "noise.step: 1 does not divide the sampling interval 0.5"),
        ({"gravity": "none"}, {"t_end": None}, "t_end: missing; this scene has no terminal shape"),
    ],
)
def test_integrators_that_do_not_fit_the_scene_are_refused(values, how, start):
    """Noise needs its integrator, and that one needs noise; steps divide the sampling interval."""
    with pytest.raises(InputError) as error:
        simulate(Scene(**BASE, **values), Numerics(**({"t_end": 1.0} | how)))
    assert str(error.value).startswith(start) and "\n" not in str(error.value)


@pytest.mark.parametrize("interval", [0.5, 1.0, 0.3])
@pytest.mark.parametrize("noise", [{"peclet": 1e-3, "step": 0.5}, {"peclet": 0.1, "step": 0.07}, {"peclet": 1}])
def test_the_proposed_step_is_accepted_and_the_longest(interval, noise):
    """The first advice is taken; one part less in the interval would be too long, or no better than what was given."""
    how, refused = Numerics(interval=interval, t_end=1.0), ""
    try:
        how.for_scene(Scene(**BASE, noise=noise))
    except InputError as error:
        refused = str(error)
    match = re.search(r"; give ([\d.e-]+), or ", refused)
    assert bool(match) == bool(refused)
    if match:
        step = float(match[1])
        how.for_scene(Scene(**BASE, noise=noise | {"step": step}))
        parts = round(interval / step) - 1
        if parts and interval / parts <= noise["step"]:
            with pytest.raises(InputError, match="too long"):
                how.for_scene(Scene(**BASE, noise=noise | {"step": interval / parts}))


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


ROWS = [[2.0 * k, 0.3 * k * k] for k in range(5)]


def turned(x, angle):
    """Rows (N, 2) turned about the centre bead by ``angle``."""
    c, s = math.cos(angle), math.sin(angle)
    return (np.array(x) - x[2]) @ np.array([[c, s], [-s, c]])


@pytest.mark.parametrize("angle", [0.0, 0.7, -2.0])
def test_start_shapes(tmp_path, angle):
    """Rows, an array, .csv, .npy and a trajectory's last sample are one start, turned by θ₀, never tilted."""
    np.savetxt(tmp_path / "x.csv", ROWS, delimiter=",")
    np.save(tmp_path / "x.npy", ROWS)
    run = simulate(Scene(100, 0.7, 5), t_end=1.0)
    run.positions[-1] = np.column_stack([ROWS, np.zeros(5)])
    write_trajectory(run, tmp_path / "x.parquet")
    files = [{"file": str(tmp_path / f"x.{kind}")} for kind in ("csv", "npy", "parquet")]
    for shape in (ROWS, tuple(map(tuple, ROWS)), np.array(ROWS), *files):
        scene = Scene(1000, angle, 5, shape=shape)
        assert_allclose(scene.start(), turned(ROWS, angle), rtol=0, atol=1e-14)
        assert scene.start_angle == angle
    (tmp_path / "empty.npy").touch()
    assert refusal(shape={"file": str(tmp_path / "empty.npy")}).startswith("shape.file: cannot read ")
    spatial = np.column_stack([ROWS, [1.0, 0.0, 5.0, 0.0, 2.0]])
    x = Scene(1000, angle, 5, space="volume", shape=spatial).start()
    assert_allclose(x, np.column_stack([turned(ROWS, angle), spatial[:, 2] - 5.0]), rtol=0, atol=1e-14)


@pytest.mark.parametrize("shape", ["rest", "straight", None])
def test_rest_shape_of_a_curved_fiber(shape):
    """ "rest" is the arc of its curvature turned by θ₀; a straight start stays straight, bonds of length 2."""
    x = Scene(1000, 0.7, 11, bending={"curvature": 0.1}, shape=shape).start()
    arc = rest_arc(11, 0.1 if shape == "rest" else 0.0, 2)
    assert_allclose(x, arc @ np.array([[math.cos(0.7), math.sin(0.7)], [-math.sin(0.7), math.cos(0.7)]]), atol=1e-13)
    assert_allclose(np.linalg.norm(np.diff(x, axis=0), axis=1), 2.0, rtol=1e-14)


@pytest.mark.parametrize("shape", ["arc", 3, [[0, 0, 0, 0]] * 5, [[1, 2], [3]], [[0, NAN]] * 5, {"fil": "x.csv"}])
def test_bad_shapes_are_refused(shape):
    """One line with what a shape may be."""
    line = refusal(shape=shape)
    assert line.startswith("shape: ") and "give straight, rest, {file: PATH}, or 5 rows of 2 or 3 finite" in line


@pytest.mark.parametrize("rows", [1, 4, 21])
def test_a_shape_of_another_number_of_beads_is_told_by_its_rows(rows):
    """Not by its numbers, of which there are too many."""
    line = refusal(shape=[[2.0 * k, 0.0] for k in range(rows)])
    assert line == f"shape: a row count of {rows} is not allowed; give 5 rows, one a bead (n_beads)"


@given(seed=st.integers(0, 10**6), amplitude=st.floats(0.0, 0.5))
def test_disturbance_is_seeded_and_bounded(seed, amplitude):
    """In the plane x and y move, out of it z, every bead within ± amplitude, the same for the same seed."""
    for space, direction, moved in (("plane", "in-plane", [0, 1]), ("volume", "in-plane", [0, 1]),
                                    ("volume", "out-of-plane", [2])):  # fmt: skip
        part = {"amplitude": amplitude, "direction": direction}
        values = BASE | {"space": space, "seed": seed, "hydrodynamics": "RPY-overlap"}
        x, again = (Scene(**values, disturbance=part).start() for _ in range(2))
        moves = x - Scene(**values).start()
        assert np.array_equal(x, again)
        assert abs(moves).max() <= amplitude + 1e-15
        still = [k for k in range(x.shape[1]) if k not in moved]
        assert not moves[:, still].any() and (amplitude < 1e-9 or moves[:, moved].all())
        other = Scene(**(values | {"seed": seed + 1}), disturbance=part).start()
        assert amplitude < 1e-9 or not np.array_equal(other, x)


def test_several_fibers_have_their_own_places_angles_and_moduli():
    """What a fiber leaves out is the scene's; an exactly horizontal one is tilted like a single one."""
    fibers = [{}, {"place": [40, 0], "theta0": -0.3}, {"place": [0, 40], "B": 500}, {"place": [0, -40], "theta0": 0}]
    scene = Scene(**BASE, fibers=fibers)
    x = scene.start().reshape(4, 5, 2)
    assert_allclose(x[:, 2], [[0, 0], [40, 0], [0, 40], [0, -40]], atol=1e-14)
    bonds = np.diff(x, axis=1)
    angles = np.arctan2(bonds[..., 1], bonds[..., 0])
    assert_allclose(angles, np.repeat([[0.7], [-0.3], [0.7], [angles[3, 0]]], 4, axis=1), rtol=0, atol=1e-13)
    assert abs(angles[3, 0]) == pytest.approx(1e-4)
    assert scene.n_fibers == 4
    assert scene.moduli == pytest.approx([3.0, 3.0, 6.0, 3.0])


def test_effects_lists_every_part(capsys):
    """``sedfiber effects``: a line an effect and one a parameter, with unit and default; --json says the same."""
    assert main(["effects"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert main(["effects", "--json"]) == 0
    effects = {effect["key"]: effect for effect in json.loads(capsys.readouterr().out)}
    assert set(effects) == {*Scene.__dataclass_fields__, "numerics"}
    assert [one["name"] for one in effects["numerics"]["parameters"]] == [*Numerics.__dataclass_fields__]
    assert effects["B"]["default"] == "required" and effects["shape"]["default"] == "none"
    assert effects["tilt"]["default"] == Scene.tilt and effects["seed"]["default"] == 0
    assert len(lines) == sum(1 + len(effect["parameters"]) for effect in effects.values())
    for part in PARTS:
        effect = effects[part.key]
        default = "in the scene" if getattr(Scene(**BASE), part.key) else "none"
        at = lines.index(f"{part.key}: {part.summary} (default: {default}; source: {part.source})")
        assert (effect["summary"], effect["source"], effect["default"]) == (part.summary, part.source, default)
        assert [one["name"] for one in effect["parameters"]] == part.names()
        for one, line in zip(effect["parameters"], lines[at + 1 :], strict=False):
            assert one["unit"] and one["meaning"] and line.split()[0] == one["name"]
            assert line.endswith(f"{one['meaning']} [{one['unit']}] (default: {one['default']})")


def test_options_mend_a_file_that_is_wrong_without_them(tmp_path):
    """`simulate flat.yaml --space volume` where the file alone would be refused: options are merged first."""
    path, out = tmp_path / "flat.yaml", tmp_path / "x.parquet"
    path.write_text("B: 1000\ntheta0: 0.5\nn_beads: 5\nwall: {point: [0, -50, 0]}\nnumerics: {t_end: 1}\n")
    assert main(["simulate", str(path), "-o", str(out)]) == 1
    assert main(["simulate", str(path), "--space", "volume", "-o", str(out)]) == 0


def test_large_seeds_are_kept_to_the_last_digit():
    """Two seeds that a double would take for one draw different disturbances."""
    seeds = (2**60, 2**60 + 1)
    starts = [Scene(1, 0.5, 5, seed=s, disturbance={"amplitude": 0.1, "direction": "in-plane"}).start() for s in seeds]
    assert not np.array_equal(*starts)
