"""``sedfiber effects``: every key of a scene and every effect it may list, with parameters, units, defaults, source."""

import argparse
import json
from dataclasses import MISSING, Field, fields
from typing import Any

from sedfiber.physics.integrators import INTEGRATORS, STOCHASTIC
from sedfiber.scene.fields import HYDRODYNAMICS, MOST_BEADS, SPACES
from sedfiber.scene.numerics import DEFAULT_INTEGRATOR, Numerics
from sedfiber.scene.part import Part
from sedfiber.scene.parts import PARTS
from sedfiber.scene.scene import Scene

# Keys of a scene that are no parts: what they mean, and the source.
KEYS = {
    "B": (
        "elasto-gravitational number ℬ = 32 Δρ g ℓ³/(E a²); sets the modulus ℰ = 24 N³/ℬ without gravity too",
        "Fox & Graham 2024",
    ),
    "theta0": ("inclination of the start to the x-axis in rad, from -π to π", "-"),
    "n_beads": (f"beads of each fiber, an odd number from 1 to {MOST_BEADS}", "-"),
    "space": (f"one of {', '.join(SPACES)}; integrate x and y of planar motion, or x, y and z", "-"),
    "hydrodynamics": (
        f"one of {', '.join(HYDRODYNAMICS)}; none: each bead alone; Oseen: far field; RPY: the paper's form; "
        "RPY-overlap: with that for r < 2a",
        "Stokes 1851; Oseen 1927; Rotne & Prager 1969; Yamakawa 1970",
    ),
    "tilt": ("inclination in rad, from 0 to 0.1, that replaces a theta0 of exactly 0; 0 for exact symmetry", "-"),
    "seed": ("a whole number from 0 up that draws the sign of the tilt, the disturbance and the noise", "-"),
    "shape": (
        "the start, which theta0 turns: straight, rest (a curved fiber's), {file: PATH} (.csv, .npy, .parquet of a "
        "trajectory), or n_beads rows of 2 or 3 numbers in a",
        "-",
    ),
    "depth": ("of the vessel in a, for the audit alone", "-"),
}
# Keys under numerics: unit and meaning.
NUMERICS = {
    "integrator": (
        "-",
        f"one of {', '.join((*INTEGRATORS, STOCHASTIC))}; none is {DEFAULT_INTEGRATOR}, with noise {STOCHASTIC}",
    ),
    "rtol": ("-", "relative tolerance of a step, from 1e-13 to 0.1"),
    "atol": ("a", "absolute tolerance of a step, from 1e-13 to 0.1"),
    "interval": ("a/U_s", "sample spacing"),
    "max_time": ("a/U_s", "by when a run without t_end must have settled"),
    "t_end": ("a/U_s", "end of the run, whose last sample is at or before it; none is when the fiber has settled"),
    "estimate_error": ("-", "repeat the run at tighter tolerances and record how far the two differ"),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Text for people, JSON for programs."""
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(args: argparse.Namespace) -> None:
    """Print the list."""
    effects = [_key(key) for key in KEYS] + [_effect(part) for part in PARTS] + [_numerics()]
    if args.json:
        print(json.dumps(effects))
        return
    for effect in effects:
        print(f"{effect['key']}: {effect['summary']} (default: {effect['default']}; source: {effect['source']})")
        for one in effect["parameters"]:
            print(f"    {one['name']:14s} {one['meaning']} [{one['unit']}] (default: {one['default']})")


def _key(key: str) -> dict[str, Any]:
    """A key of the scene that is no part."""
    summary, source = KEYS[key]
    default = _default(Scene.__dataclass_fields__[key])
    return {"key": key, "summary": summary, "default": default, "source": source, "parameters": []}


def _numerics() -> dict[str, Any]:
    """The entry of the numerics."""
    return {
        "key": "numerics",
        "summary": "how the scene is integrated",
        "default": "in the scene",
        "source": "-",
        "parameters": [
            {
                "name": one.name,
                **dict(zip(("unit", "meaning"), NUMERICS[one.name], strict=True)),
                "default": _default(one),
            }
            for one in fields(Numerics)
        ],
    }


def _effect(part: type[Part]) -> dict[str, Any]:
    """A part of the scene and its parameters."""
    default = Scene.__dataclass_fields__[part.key].default
    return {
        "key": part.key,
        "summary": part.summary,
        "default": "in the scene" if default else "none",
        "source": part.source,
        "acts_in": part.acts_in,
        "parameters": [{"name": one.name, **one.metadata, "default": _default(one)} for one in fields(part)],
    }


def _default(one: Field) -> Any:
    """A default as YAML would have it."""
    if one.default is MISSING:
        return "required"
    if one.default is None:
        return "none"
    return list(one.default) if isinstance(one.default, tuple) else one.default
