"""What is simulated: one fiber, its start, and the effects that act on it."""

import math
from dataclasses import asdict, dataclass

import numpy as np

from sedfiber._typing import Positions
from sedfiber.errors import InputError
from sedfiber.validation import number_within, one_of, positive_number, refused, whole_number

SPACES = {"plane": 2, "volume": 3}
HYDRODYNAMICS = ("RPY", "RPY-overlap")
MOST_BEADS = 2001  # the dense Jacobian of more in volume would not fit in a few hundred MB


@dataclass(frozen=True)
class Scene:
    """A straight fiber released at an angle in a quiescent fluid.

    ``B`` is the elasto-gravitational number ``ℬ = 32 Δρ g ℓ³/(E a²)``; the dimensionless
    modulus follows as ``ℰ = 24 N³/ℬ``.  ``theta0`` is the inclination to the x-axis in
    radians.  A start at exactly ``theta0 = 0`` is tilted by ``tilt`` radians, with a sign
    drawn from ``seed``: at high ℬ the symmetric start settles onto an unstable W-shape
    and would leave it by round-off alone.  ``tilt = 0`` asks for exact symmetry.

    Raises InputError for any value that is not allowed.
    """

    B: float
    theta0: float
    n_beads: int = 31
    space: str = "plane"
    hydrodynamics: str = "RPY"
    tilt: float = 1e-4
    seed: int = 0

    def __post_init__(self) -> None:
        self._set("B", positive_number("B", self.B))
        self._set("theta0", number_within("theta0", self.theta0, -math.pi, math.pi, "radians between -π and π"))
        odd = f"an odd number from 3 to {MOST_BEADS}"
        self._set("n_beads", whole_number("n_beads", self.n_beads, odd, 3, MOST_BEADS))
        if self.n_beads % 2 == 0:
            raise refused("n_beads", self.n_beads, odd)
        one_of("space", self.space, SPACES)
        one_of("hydrodynamics", self.hydrodynamics, HYDRODYNAMICS)
        self._set("tilt", number_within("tilt", self.tilt, 0.0, 0.1, "radians between 0 and 0.1"))
        self._set("seed", whole_number("seed", self.seed, "a whole number from 0 up"))

    def _set(self, key: str, value: float) -> None:
        """Store the converted value: a command hands over text."""
        object.__setattr__(self, key, value)

    @property
    def dim(self) -> int:
        """Coordinates per bead that are integrated: 2 in the plane, 3 in volume."""
        return SPACES[self.space]

    @property
    def length(self) -> float:
        """Contour length ``L = 2 N`` at rest."""
        return 2.0 * self.n_beads

    @property
    def modulus(self) -> float:
        """``ℰ = Eπa²/(6πμaU_s) = 24 N³/ℬ``."""
        return 24.0 * self.n_beads**3 / self.B

    @property
    def force_consistent_B(self) -> float:
        """``W L²/EI`` as other papers use it, with the weight of N spheres: ``(2/3) ℬ``."""
        return 2.0 * self.B / 3.0

    @property
    def start_angle(self) -> float:
        """``theta0``, or the seeded tilt where ``theta0`` is exactly zero."""
        if self.theta0 != 0.0 or self.tilt == 0.0:
            return self.theta0
        return self.tilt * float(np.random.default_rng(self.seed).choice([1.0, -1.0]))

    def start(self) -> Positions:
        """Straight fiber at rest, beads touching, centre bead at the origin, shape (N, d)."""
        arc = 2.0 * (np.arange(self.n_beads) - self.n_beads // 2)
        x = np.zeros((self.n_beads, self.dim))
        # exactly vertical means exactly: cos(π/2) is 6e-17 and would seed a buckling
        cos = 0.0 if abs(self.start_angle) == math.pi / 2 else math.cos(self.start_angle)
        x[:, 0], x[:, 1] = arc * cos, arc * math.sin(self.start_angle)
        return x

    def to_dict(self) -> dict:
        """Plain values for a file's metadata."""
        return asdict(self)

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
            name = sorted(unknown or missing)[0]
            what = "unknown key" if unknown else "missing key"
            raise InputError(f"scene: {what} {name!r}; keys are {', '.join(cls.__dataclass_fields__)}")
        return cls(**values)
