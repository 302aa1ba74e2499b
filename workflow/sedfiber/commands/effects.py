"""``sedfiber effects``: every effect that a scene may list, with parameters, units, defaults and source."""

import argparse
import json
from dataclasses import MISSING, fields
from typing import Any

from sedfiber.scene import HYDRODYNAMICS, SPACES, Scene
from sedfiber.scene_part import Part
from sedfiber.scene_parts import PARTS

CHOICES = {
    "space": (SPACES, "integrate x and y of planar motion, or x, y and z", "-"),
    "hydrodynamics": (
        HYDRODYNAMICS,
        "none: each bead alone; Oseen: far field; RPY: the source's form; RPY-overlap: with that for r < 2a",
        "Stokes 1851; Oseen 1927; Rotne & Prager 1969; Yamakawa 1970",
    ),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Text for people, JSON for programs."""
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(args: argparse.Namespace) -> None:
    """Print the list."""
    effects = [_choice(key) for key in CHOICES] + [_effect(part) for part in PARTS]
    if args.json:
        print(json.dumps(effects))
        return
    for effect in effects:
        print(f"{effect['key']}: {effect['summary']} (default: {effect['default']}; source: {effect['source']})")
        for one in effect["parameters"]:
            print(f"    {one['name']:12s} {one['meaning']} [{one['unit']}] (default: {one['default']})")


def _choice(key: str) -> dict[str, Any]:
    """A key of the scene that is one word of a few."""
    choices, summary, source = CHOICES[key]
    default = Scene.__dataclass_fields__[key].default
    return {
        "key": key,
        "summary": f"one of {', '.join(choices)}; {summary}",
        "default": default,
        "source": source,
        "parameters": [],
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
        "parameters": [
            {"name": one.name, **one.metadata, "default": "required" if one.default is MISSING else _shown(one.default)}
            for one in fields(part)
        ],
    }


def _shown(value: Any) -> Any:
    """A default as YAML would have it."""
    if value is None:
        return "none"
    return list(value) if isinstance(value, tuple) else value
