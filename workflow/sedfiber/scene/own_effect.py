"""An effect that a user brings, written in plain NumPy: what it lacks is filled in here.

A user's class has ``force(x)`` (N, d) → (N, d), or ``velocity(x)`` for a flow, of laboratory
positions; optionally ``energy(x)``, whose fall is then part of the energy balance.  Its Jacobian
is taken by central differences with a step of 1e-5 a, right to nine digits within 100 a of the
origin: an implicit method needs it for speed, and the solution does not depend on it.
"""

import hashlib
import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from sedfiber.core.array_types import Array, Matrix, Positions
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.scene.parts import Own

_STEP = 1e-5  # a; about the cube root of the rounding error, which balances the two errors of a central difference


class _OwnEffect:
    """A user's ``function(x)`` of laboratory positions, checked, with its Jacobian by differences."""

    needs_lab_frame = True
    banded = False

    def __init__(self, name: str, function: Any):
        self._name, self._function = name, function

    def _value(self, x: Positions) -> Positions:
        value = _asked(self._name, self._function, x)
        what = f"shape {value.shape}" if value.shape != x.shape else ""
        if what or not np.isfinite(value).all():
            what = what or "a number that is not finite"
            raise NumericalError(f"own: {self._name} returned {what}; return finite numbers of shape {x.shape}")
        return value

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add the derivative to ``jac``, at least (N d, N d)."""
        for column in range(x.size):
            step = np.zeros(x.size)
            step[column] = _STEP
            ahead, behind = (self._value(x + s * step.reshape(x.shape)) for s in (1.0, -1.0))
            jac[: x.size, column] += (ahead - behind).ravel() / (2.0 * _STEP)


def _asked(name: str, function: Any, x: Positions) -> Array:
    """Call the user's code on a copy of ``x``; raises NumericalError where it fails."""
    try:
        return np.asarray(function(x.copy()), dtype=float)
    except Exception as error:
        why = " ".join(f"{type(error).__name__}: {error}".split())
        raise NumericalError(f"own: {name} failed ({why}); it is given numbers of shape {x.shape}") from None


class OwnForce(_OwnEffect):
    """A force; conservative if the user's class has an energy."""

    def __init__(self, name: str, effect: Any):
        super().__init__(name, effect.force)
        if hasattr(effect, "energy"):
            self.energy = lambda x: float(_asked(f"the energy of {name}", lambda y: float(effect.energy(y)), x))

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the user's force, shape (N, d)."""
        force += self._value(x)


class OwnFlow(_OwnEffect):
    """A velocity that carries beads along."""

    def __init__(self, name: str, effect: Any):
        super().__init__(name, effect.velocity)

    def add_velocity(self, x: Positions, u: Positions) -> None:
        """Add the user's velocity, shape (N, d)."""
        u += self._value(x)


def load_own(own: Own) -> OwnForce | OwnFlow:
    """The user's class from the user's file; raises InputError when there is no such thing."""
    path = Path(own.file)
    if not path.is_file():
        raise InputError(f"own.file: {own.file!r} does not exist; give the path of a Python file")
    name = f"sedfiber_own_{hashlib.sha256(str(path.resolve()).encode()).hexdigest()[:12]}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"own.file: {own.file!r} is not a Python file; give one whose name ends in .py")
    module = sys.modules[name] = importlib.util.module_from_spec(spec)  # where a dataclass looks for its module
    try:
        spec.loader.exec_module(module)
        effect = _class_of(module, own)(**(own.parameters or {}))
    except InputError:
        raise
    except Exception as error:
        why = f"{type(error).__name__}: {error}".splitlines()[0]
        raise InputError(f"own: cannot make {own.effect!r} from {own.file!r} ({why})") from None
    kinds: dict[str, type[OwnForce] | type[OwnFlow]] = {"force": OwnForce, "velocity": OwnFlow}
    found = [method for method in kinds if callable(getattr(effect, method, None))]
    if len(found) == 1:
        return kinds[found[0]](own.effect, effect)
    if found:
        raise InputError(f"own.effect: {own.effect!r} has both force(x) and velocity(x); make it two classes")
    raise InputError(f"own.effect: {own.effect!r} has neither force(x) nor velocity(x); write one of them")


def _class_of(module: ModuleType, own: Own) -> type:
    """The class of that name; raises InputError with the names there are."""
    if own.effect not in vars(module):
        there = ", ".join(name for name, value in vars(module).items() if isinstance(value, type)) or "no class"
        raise InputError(f"own.effect: {own.effect!r} is not in {own.file!r}, but {there}; give the name of a class")
    return getattr(module, own.effect)
