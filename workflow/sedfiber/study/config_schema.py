"""Validation of ``config.yaml`` against its schema, one line per fault."""

import math
from pathlib import Path
from typing import Any

import yaml
from jsonschema import Draft202012Validator, ValidationError

from sedfiber.core.errors import InputError
from sedfiber.core.validation import EXPONENT


def validate(config: dict[str, Any], schema: Path) -> None:
    """Raise InputError that names key, value and what is allowed.

    Numbers that YAML 1.1 takes for text, such as 1e-3, are made numbers in ``config`` first.
    """
    _read_exponents(config)
    _require_finite("", config)
    rules = yaml.safe_load(schema.read_text(encoding="utf-8"))
    faults = sorted(Draft202012Validator(rules).iter_errors(config), key=lambda fault: list(map(str, fault.path)))
    if faults:
        raise InputError(f"config: {describe(faults[0])}")


def describe(fault: ValidationError) -> str:
    """Key, value and what is allowed, from the schema's own words."""
    key = ".".join(str(part) for part in fault.absolute_path) or "top level"
    if fault.validator == "additionalProperties":
        known = fault.schema["properties"]
        unknown = next(name for name in fault.instance if name not in known)
        return f"{key}: unknown key {unknown!r}; keys are {', '.join(known)}"
    if fault.validator == "required":
        missing = next(name for name in fault.validator_value if name not in fault.instance)
        return f"{key}: key {missing!r} is missing"
    allowed = fault.schema.get("description", f"{fault.validator} {fault.validator_value}")
    return f"{key}: {fault.instance!r} is not allowed; give {allowed}"


def _read_exponents(config: dict | list) -> None:
    """In place, at every depth."""
    for name, child in list(config.items() if isinstance(config, dict) else enumerate(config)):
        if isinstance(child, dict | list):
            _read_exponents(child)
        elif isinstance(child, str) and EXPONENT.match(child):
            config[name] = float(child)


def _require_finite(key: str, value: Any) -> None:
    """JSON knows no NaN, so the schema's comparisons let it pass; YAML writes ``.nan``."""
    if isinstance(value, dict | list):
        children = value.items() if isinstance(value, dict) else enumerate(value)
        for name, child in children:
            _require_finite(f"{key}.{name}".lstrip("."), child)
    elif isinstance(value, float) and not math.isfinite(value):
        raise InputError(f"config: {key}: {value!r} is not allowed; give a finite number")
