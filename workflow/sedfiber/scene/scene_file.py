"""Scenes as YAML files: the keys of ``Scene``, and under ``numerics`` those of ``Numerics``."""

from pathlib import Path
from typing import Any

import yaml

from sedfiber.core.errors import InputError
from sedfiber.core.validation import EXPONENT
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.part import Part
from sedfiber.scene.parts import PARTS, Contact, Fiber, Own
from sedfiber.scene.scene import Scene


class _Loader(yaml.SafeLoader):
    """Safe YAML in which 1e-3 is a number and a key may be given once."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict:
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        for key in keys:
            if keys.count(key) > 1:
                raise yaml.YAMLError(f"key {key!r} is given twice")
        return super().construct_mapping(node, deep)


_Loader.add_implicit_resolver("tag:yaml.org,2002:float", EXPONENT, list("-+.0123456789"))


def read_scene(path: str | Path, **changes: Any) -> tuple[Scene, Numerics]:
    """A scene, with ``changes`` to its keys, and how to integrate it; raises InputError naming the key that is wrong.

    Files that the scene names (a start shape, an effect of the user's) are looked for beside it.
    """
    values = _mapping(Path(path))
    how = values.pop("numerics", None) or {}
    if not isinstance(how, dict):
        raise InputError(f"numerics: {how!r} is not allowed; give {{{', '.join(Numerics.__dataclass_fields__)}}}")
    for key in how:
        if key not in Numerics.__dataclass_fields__:
            raise InputError(f"numerics: unknown key {key!r}; keys are {', '.join(Numerics.__dataclass_fields__)}")
    _require_known(values)
    _look_beside(values, Path(path).parent)
    return Scene.from_dict(values | changes), Numerics(**how)


def _require_known(values: dict[str, Any]) -> None:
    """Keys of a scene alone, and none that names a part and then says nothing of it."""
    for key, value in values.items():
        if key in Numerics.__dataclass_fields__:
            raise InputError(f"scene: key {key!r} is not allowed here; give it under numerics: {{ {key}: {value!r} }}")
        if key not in Scene.__dataclass_fields__:
            raise InputError(f"scene: unknown key {key!r}; keys are {', '.join(Scene.__dataclass_fields__)}, numerics")
    for part in PARTS:
        if part.key in values and values[part.key] is None and not Scene.__dataclass_fields__[part.key].default:
            raise InputError(f"{part.key}: is empty; give {_filled(part)}, or none")


def _filled(part: type[Part]) -> str:
    """The parameters that may stand behind the key of a part."""
    if part is Contact:
        return "{} for the defaults"
    words = f"{{{', '.join(part.names())}}}"
    return f"a list of {words}" if part in (Fiber, Own) else words


def _mapping(path: Path) -> dict[str, Any]:
    try:
        values = yaml.load(path.read_text(encoding="utf-8"), Loader=_Loader)  # a SafeLoader
    except OSError as error:
        raise InputError(f"scene: cannot read {str(path)!r} ({error.strerror})") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        why = " ".join(str(error).split())
        raise InputError(f"scene: {str(path)!r} is not YAML ({why})") from None
    if not isinstance(values, dict):
        raise InputError(f"scene: {str(path)!r} is not a mapping of keys to values; give at least B and theta0")
    return values


def _look_beside(values: dict[str, Any], folder: Path) -> None:
    """Make relative paths relative to the scene's folder."""
    own = values.get("own")
    for part in [values.get("shape"), *(own if isinstance(own, list) else ())]:
        if isinstance(part, dict) and isinstance(part.get("file"), str):
            part["file"] = str(folder / part["file"])
