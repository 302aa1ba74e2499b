"""The parts a scene lists: read from plain values, from files, from the command line; refused by name."""

import json
import math
import re

import numpy as np
import pytest
from scene_examples import BASE, EXAMPLES, LISTS, WALL, refusal

from sedfiber import InputError, Numerics, Scene, simulate
from sedfiber.commands.cli import main
from sedfiber.scene.parts import PARTS


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
