"""What is simulated: fibers, their start, and the effects that act on them."""

import math
from dataclasses import dataclass, fields
from typing import Any

from sedfiber._typing import Positions
from sedfiber.errors import InputError
from sedfiber.scene_parts import Bending, Contact, Disturbance, Fiber, Flow, Gravity, Noise, Own, Stretching, Wall
from sedfiber.scene_rules import is_symmetric, require_sense
from sedfiber.start import fiber_angle, read_shape, start_positions
from sedfiber.validation import number_within, one_of, positive_number, refused, whole_number

SPACES = {"plane": 2, "volume": 3}
HYDRODYNAMICS = ("none", "Oseen", "RPY", "RPY-overlap")
MOST_BEADS = 2001  # the dense Jacobian of more in volume would not fit in a few hundred MB


@dataclass(frozen=True)
class Scene:
    """Fibers released in a viscous fluid, and the effects that act on them; those not listed are not there.

    ``B`` is the elasto-gravitational number ``ℬ = 32 Δρ g ℓ³/(E a²)``; the dimensionless
    modulus follows as ``ℰ = 24 N³/ℬ``, also where there is no gravity.  ``theta0`` is the
    inclination to the x-axis in radians.  A straight start at exactly ``theta0 = 0`` is tilted
    by ``tilt`` radians, with a sign drawn from ``seed``: at high ℬ the symmetric start settles
    onto an unstable W-shape and would leave it by round-off alone.  ``tilt = 0`` asks for exact
    symmetry.  ``shape`` is None for a straight start, "rest" for the rest shape of a curved
    fiber, or positions (N, 2 or 3) that ``theta0`` turns about the centre bead.  ``seed`` draws
    all that is random.  ``depth`` is that of the vessel, for the audit alone.

    The parts are records of ``sedfiber.scene_parts``; a mapping of their parameters does as
    well, and None or "none" leaves one out.  Without any of them the scene is the study's.

    Raises InputError for any value that is not allowed, and for parts that do not go together.
    """

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
        require_sense(self)

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

    @property
    def start_angle(self) -> float:
        """``theta0``, or the seeded tilt where a straight start is exactly horizontal."""
        return fiber_angle(self, Fiber())

    def start(self) -> Positions:
        """Bead positions at t = 0, fiber after fiber, shape (beads, d)."""
        return start_positions(self)

    @property
    def has_terminal_shape(self) -> bool:
        """Whether the fiber settles to the steady U: one straight-at-rest fiber that nothing but gravity drives."""
        extras = (self.wall, self.flow, self.noise, *self.own)
        elastic = self.stretching is not None and self.bending is not None and self.bending.curvature == 0.0
        falls = self.gravity == Gravity() and self.hydrodynamics in ("RPY", "RPY-overlap")
        return falls and elastic and not self.fibers and self.n_beads >= 3 and not any(extras)

    @property
    def is_mirror_symmetric(self) -> bool:
        """Whether exact left–right symmetry was asked for, by ``tilt = 0``, and start and effects have it."""
        return self.tilt == 0.0 and is_symmetric(self)

    def to_dict(self) -> dict:
        """Plain values for a file's metadata; parts that a scene need not have appear only if it has them."""
        values = {one.name: _plain(getattr(self, one.name)) for one in fields(self)}
        kept = {"gravity", "stretching", "bending"}  # leaving these out is worth a word
        return {key: value for key, value in values.items() if key in kept or value not in (None, [])}

    def facts(self) -> dict:
        """What every file of this scene records: the scene and both elasto-gravitational numbers."""
        return {
            "scene": self.to_dict() | {"start_angle": self.start_angle},
            "B": self.B,
            "B_force_consistent": self.force_consistent_B,
            "modulus": self.modulus,
        }

    @classmethod
    def from_dict(cls, values: dict) -> "Scene":
        """The inverse of ``to_dict``; raises InputError for an unknown or missing key."""
        unknown = set(values) - set(cls.__dataclass_fields__)
        missing = {"B", "theta0"} - set(values)
        if unknown or missing:
            name = sorted(unknown or missing, key=str)[0]
            what = "unknown key" if unknown else "missing key"
            raise InputError(f"scene: {what} {name!r}; keys are {', '.join(cls.__dataclass_fields__)}")
        return cls(**values)


def _each(kind: type, values: Any) -> tuple:
    """A list of parts."""
    if values is None or values == "none":
        return ()
    if not isinstance(values, list | tuple):
        raise refused(kind.key, values, f"a list of {{{', '.join(kind.names())}}}")
    return tuple(part for part in map(kind.read, values) if part is not None)


def _plain(value: Any) -> Any:
    """Parts as mappings, tuples as lists."""
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    return value
