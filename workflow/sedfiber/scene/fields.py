"""The fields of a scene, each checked by itself, and what follows from them alone."""

import math
from dataclasses import dataclass
from typing import Any

from sedfiber.core.validation import number_within, one_of, positive_number, refused, whole_number
from sedfiber.scene.part import Part
from sedfiber.scene.parts import Bending, Contact, Disturbance, Fiber, Flow, Gravity, Noise, Own, Stretching, Wall
from sedfiber.scene.shape import read_shape

SPACES = {"plane": 2, "volume": 3}
HYDRODYNAMICS = ("none", "Oseen", "RPY", "RPY-overlap")
MOST_BEADS = 2001  # the dense Jacobian of more in volume would not fit in a few hundred MB


@dataclass(frozen=True)
class SceneFields:
    """The fields of `Scene`, each checked by itself; raises InputError for a value that is not allowed."""

    B: float
    theta0: float
    n_beads: int = 31
    space: str = "plane"
    hydrodynamics: str = "RPY"
    tilt: float = 1e-4
    seed: int = 0
    gravity: Gravity | None = Gravity()
    stretching: Stretching | None = Stretching()
    bending: Bending | None = Bending()
    wall: Wall | None = None
    flow: Flow | None = None
    contact: Contact | None = None
    noise: Noise | None = None
    fibers: tuple[Fiber, ...] = ()
    shape: Any = None
    disturbance: Disturbance | None = None
    own: tuple[Own, ...] = ()
    depth: float | None = None

    def __post_init__(self) -> None:
        self._set("B", positive_number("B", self.B))
        self._set("theta0", number_within("theta0", self.theta0, -math.pi, math.pi, "radians between -π and π"))
        odd = f"an odd number from 1 to {MOST_BEADS}"
        self._set("n_beads", whole_number("n_beads", self.n_beads, odd, 1, MOST_BEADS))
        if self.n_beads % 2 == 0:
            raise refused("n_beads", self.n_beads, odd)
        one_of("space", self.space, SPACES)
        one_of("hydrodynamics", self.hydrodynamics, HYDRODYNAMICS)
        self._set("tilt", number_within("tilt", self.tilt, 0.0, 0.1, "radians between 0 and 0.1"))
        self._set("seed", whole_number("seed", self.seed, "a whole number from 0 up"))
        for part in (Gravity, Stretching, Bending, Wall, Flow, Contact, Noise, Disturbance):
            self._set(part.key, part.read(getattr(self, part.key)))
        self._set("fibers", _each(Fiber, self.fibers))
        self._set("own", _each(Own, self.own))
        self._set("shape", read_shape(self.shape, self.n_beads, self.dim))
        if self.depth is not None:
            self._set("depth", positive_number("depth", self.depth))

    def _set(self, key: str, value: Any) -> None:
        """Store the converted value: a command hands over text."""
        object.__setattr__(self, key, value)

    @property
    def dim(self) -> int:
        """Coordinates per bead that are integrated: 2 in the plane, 3 in volume."""
        return SPACES[self.space]

    @property
    def n_fibers(self) -> int:
        """Number of fibers, ``n_beads`` beads each."""
        return len(self.fibers) or 1

    @property
    def length(self) -> float:
        """Contour length ``L = 2 N`` at rest."""
        return 2.0 * self.n_beads

    @property
    def modulus(self) -> float:
        """``ℰ = Eπa²/(6πμaU_s) = 24 N³/ℬ``."""
        return self.modulus_at(self.B)

    def modulus_at(self, B: float) -> float:
        """``ℰ = 24 N³/ℬ`` of a fiber with its own ``B``."""
        return 24.0 * self.n_beads**3 / B

    @property
    def stiffening(self) -> float:
        """The stiffest of the fiber's moduli over ℰ: that of its springs where these are stiffer than its material."""
        return 1.0 if self.stretching is None else max(1.0, self.stretching.factor)

    @property
    def moduli(self) -> list[float]:
        """ℰ of each fiber."""
        return [self.modulus_at(fiber.B or self.B) for fiber in self.fibers or (Fiber(),)]

    @property
    def force_consistent_B(self) -> float:
        """``W L²/EI`` as other papers use it, with the weight of N spheres: ``(2/3) ℬ``."""
        return 2.0 * self.B / 3.0


def _each(kind: type[Part], values: Any) -> tuple:
    """A list of parts."""
    if values is None or values == "none":
        return ()
    if not isinstance(values, list | tuple):
        raise refused(kind.key, values, f"a list of {{{', '.join(kind.names())}}}")
    return tuple(part for part in map(kind.read, values) if part is not None)
