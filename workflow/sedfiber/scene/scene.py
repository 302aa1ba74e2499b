"""A scene: fibers, their start, and the effects that act on them."""

from dataclasses import dataclass, fields
from typing import Any

from sedfiber.core.array_types import Positions
from sedfiber.core.errors import InputError
from sedfiber.scene.fields import SceneFields
from sedfiber.scene.parts import Fiber, Gravity
from sedfiber.scene.rules import is_symmetric, require_sense
from sedfiber.scene.start import fiber_angle, start_positions


@dataclass(frozen=True)
class Scene(SceneFields):
    """Fibers released in a viscous fluid, and the effects that act on them; those not listed are not there.

    ``B`` is the elasto-gravitational number ``ℬ = 32 Δρ g ℓ³/(E a²)``; the dimensionless
    modulus follows as ``ℰ = 24 N³/ℬ``, also where there is no gravity.  ``theta0`` is the
    inclination to the x-axis in radians.  A straight start at exactly ``theta0 = 0`` is tilted
    by ``tilt`` radians, with a sign drawn from ``seed``: at high ℬ the symmetric start settles
    onto an unstable W-shape and would leave it by round-off alone.  ``tilt = 0`` asks for exact
    symmetry.  ``shape`` is None for a straight start, "rest" for the rest shape of a curved
    fiber, or positions (N, 2 or 3) that ``theta0`` turns about the centre bead.  ``seed`` draws
    all that is random.  ``depth`` is that of the vessel, for the audit alone.

    The parts are records of ``sedfiber.scene.parts``; a mapping of their parameters does as
    well, and None or "none" leaves one out.  Without any of them the scene is the study's.

    Raises InputError for any value that is not allowed, and for parts that do not go together.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        require_sense(self)

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
        """Whether ``tilt = 0`` asks for exact left–right symmetry, and start and effects have it."""
        return self.tilt == 0.0 and is_symmetric(self)

    def to_dict(self) -> dict:
        """Plain values for a file's metadata; parts that a scene need not have appear only if it has them."""
        values = {one.name: _plain(getattr(self, one.name)) for one in fields(self)}
        kept = {"gravity", "stretching", "bending"}  # leaving these out is worth a word
        return {key: value for key, value in values.items() if key in kept or value not in (None, [])}

    def facts(self) -> dict:
        """The metadata of every file of this scene: the scene and both elasto-gravitational numbers."""
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


def _plain(value: Any) -> Any:
    """Parts as mappings, tuples as lists."""
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    return value
