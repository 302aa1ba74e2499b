"""The parts a scene may list: their parameters, units, defaults and sources.

Each part is a small record that says what it is in words and checks its own values; what it
does to the fiber is in ``sedfiber.physics``, in the module that ``acts_in`` names.
"""

import json
import math
from dataclasses import dataclass

from sedfiber.core.validation import (
    direction,
    number_within,
    one_of,
    positive_number,
    refused,
    vector,
)
from sedfiber.scene.flow import Flow
from sedfiber.scene.part import Part, parameter

DISTURBANCES = ("in-plane", "out-of-plane")


@dataclass(frozen=True)
class Gravity(Part):
    """A constant force on each bead."""

    key, acts_in = "gravity", "physics/gravity.py"
    summary = "the weight of each bead"
    source = "Fox & Graham 2024; forces are measured in the weight of one bead"

    direction: tuple = parameter("-", "where down is", (0.0, -1.0, 0.0))
    strength: float = parameter("6πμaU_s", "weight of one bead", 1.0)

    def __post_init__(self) -> None:
        self._check(direction, "direction")
        self._check(positive_number, "strength")

    @property
    def weight(self) -> tuple[float, float, float]:
        """The force on one bead."""
        x, y, z = self.direction
        return x * self.strength, y * self.strength, z * self.strength


@dataclass(frozen=True)
class Stretching(Part):
    """Springs between neighbours."""

    key, acts_in = "stretching", "physics/stretching.py"
    summary = "a spring of rest length 2a between neighbours"
    source = "Schlagberger & Netz 2005"

    factor: float = parameter("-", "stiffness over that of the fiber's material, ℰ = 24 N³/ℬ", 1.0)

    def __post_init__(self) -> None:
        self._check(positive_number, "factor")


@dataclass(frozen=True)
class Bending(Part):
    """Resistance to bending, about a straight or a curved rest shape."""

    key, acts_in = "bending", "physics/bending.py, physics/curved_bending.py"
    summary = "resistance to bending away from a straight, or a curved, rest shape"
    source = "Schlagberger & Netz 2005; intrinsic curvature: rest angle 2κ₀a"

    curvature: float = parameter("1/a", "intrinsic curvature κ₀, positive to the left from bead 0 on", 0.0)

    def __post_init__(self) -> None:
        self._check(number_within, "curvature", -1.0, 1.0, "a number from -1 to 1")


@dataclass(frozen=True)
class Wall(Part):
    """A no-slip plane."""

    key, acts_in = "wall", "physics/wall.py"
    summary = "a no-slip plane; the fiber is on the side its normal points to"
    source = "Blake 1971; Swan & Brady 2007"

    point: tuple = parameter("a", "a point of the plane")
    normal: tuple = parameter("-", "direction into the fluid", (0.0, 1.0, 0.0))

    def __post_init__(self) -> None:
        self._check(vector, "point")
        self._check(direction, "normal")


@dataclass(frozen=True)
class Contact(Part):
    """A short-range repulsion between beads that are not neighbours, and against the wall."""

    key, acts_in = "contact", "physics/contact.py, physics/wall_contact.py"
    summary = "short-range repulsion of beads that are not neighbours, and of beads and wall"
    source = "Dance, Climent & Maxey 2004"

    strength: float = parameter("6πμaU_s", "force at touching", 30.0)
    reach: float = parameter("a", "distance of centres at which it begins; half of it from the wall", 2.2)

    def __post_init__(self) -> None:
        self._check(positive_number, "strength")
        self._check(number_within, "reach", 2.01, 100.0, "a number from 2.01 to 100")


@dataclass(frozen=True)
class Noise(Part):
    """Thermal noise: Brownian motion at a Péclet number."""

    key, acts_in = "noise", "physics/integrators/stochastic.py"
    summary = "Brownian motion, kT = 1/Pe in units 6πμa²U_s"
    source = "Ermak & McCammon 1978; Fixman 1978"

    peclet: float = parameter("-", "Pe = a U_s/D of one bead, D = kT/6πμa")
    step: float = parameter("a/U_s", "time step", 0.01)

    def __post_init__(self) -> None:
        self._check(positive_number, "peclet")
        self._check(positive_number, "step")

    @property
    def temperature(self) -> float:
        """kT in units ``6πμa²U_s``."""
        return 1.0 / self.peclet


@dataclass(frozen=True)
class Disturbance(Part):
    """A small random displacement of every bead at the start."""

    key, acts_in = "disturbance", "scene/start.py"
    summary = "a seeded random displacement of every bead at the start"
    source = "uniform between ± amplitude in each coordinate"

    amplitude: float = parameter("a", "largest displacement along one axis")
    direction: str = parameter("-", f"one of {', '.join(DISTURBANCES)}", "out-of-plane")

    def __post_init__(self) -> None:
        self._check(number_within, "amplitude", 0.0, 0.5, "a number from 0 to 0.5")
        self._check(one_of, "direction", DISTURBANCES)


@dataclass(frozen=True)
class Fiber(Part):
    """One of several fibers."""

    key, acts_in = "fibers", "scene/assembly.py"
    summary = "a list of fibers, coupled through the fluid; what one leaves out is the scene's"
    source = "-"

    B: float | None = parameter("-", "its elasto-gravitational number", None)
    theta0: float | None = parameter("rad", "its inclination", None)
    place: tuple = parameter("a", "of its centre bead", (0.0, 0.0, 0.0))

    def __post_init__(self) -> None:
        if self.B is not None:
            self._check(positive_number, "B")
        if self.theta0 is not None:
            self._check(number_within, "theta0", -math.pi, math.pi, "radians between -π and π")
        self._check(vector, "place")


@dataclass(frozen=True)
class Own(Part):
    """An effect of the user's, in a Python file of theirs."""

    key, acts_in = "own", "scene/own_effect.py"
    summary = "a list of effects of your own, each a class in a Python file (docs/own_effect.md)"
    source = "yours"

    file: str = parameter("-", "path of the Python file")
    effect: str = parameter("-", "name of the class in it")
    parameters: dict | None = parameter("-", "keyword arguments of the class", None)

    def __post_init__(self) -> None:
        for name in ("file", "effect"):
            if not isinstance(getattr(self, name), str):
                raise refused(f"own.{name}", getattr(self, name), "text")
        if self.parameters is not None and not isinstance(self.parameters, dict):
            raise refused("own.parameters", self.parameters, "a mapping of names to values")
        try:
            json.dumps(self.parameters, allow_nan=False)
        except (TypeError, ValueError):
            raise refused("own.parameters", self.parameters, "values that a file's record can hold (JSON)") from None


PARTS = (Gravity, Stretching, Bending, Wall, Flow, Contact, Noise, Disturbance, Fiber, Own)
