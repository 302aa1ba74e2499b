"""The one record of a motion: samples and what is known about how they were made.

A simulated run, a forecast and a fall of a data set are all trajectories; `trajectory_file` reads and
writes one of them, `sedfiber.reduced.dataset_file` the table of many.
"""

from dataclasses import dataclass, field, replace
from typing import Any, Self

from sedfiber.core.array_types import History, Times


@dataclass(frozen=True)
class Trajectory:
    """``t`` (T,) in a/U_s, ``positions`` (T, beads, 3) in a, fiber after fiber, ``metadata`` of plain values.

    ``metadata`` holds the scene, both ℬ numbers, how the run was made, its counters, its
    checks and the settling time: deterministic facts only.  A fall of a data set has at least its
    `fall_keys`; ``split``, ``B``, ``angle_index`` and ``theta0`` are read from them.
    """

    t: Times
    positions: History
    metadata: dict = field(default_factory=dict)

    def __repr__(self) -> str:
        kind, (samples, beads, _) = self.metadata.get("kind", "trajectory"), self.positions.shape
        scene = self.metadata.get("scene", {})
        values = "".join(f", {key}={scene[key]:g}" for key in ("B", "theta0") if key in scene)
        return f"<Trajectory: {kind}{values}, {samples} samples to t = {self.t[-1]:g} a/U_s, {beads} beads>"

    def with_facts(self, **facts: Any) -> Self:
        """The same with these metadata added or changed."""
        return replace(self, metadata=self.metadata | facts)

    @property
    def n_beads(self) -> int:
        """Number of beads N of one fiber."""
        return self.metadata.get("scene", {}).get("n_beads", self.positions.shape[1])

    @property
    def length(self) -> float:
        """L = 2N of one fiber, in a."""
        return 2.0 * self.n_beads

    @property
    def fibers(self) -> History:
        """Positions fiber by fiber, (T, fibers, N, 3)."""
        return self.positions.reshape(len(self.t), -1, self.n_beads, 3)

    @property
    def centre(self) -> History:
        """Position of the centre bead, of the first fiber if there are several, (T, 3)."""
        return self.positions[:, self.n_beads // 2]

    @property
    def shape(self) -> History:
        """Positions relative to the centre bead, (T, beads, 3)."""
        return self.positions - self.centre[:, None]

    @property
    def settling_time(self) -> float | None:
        """T(ℬ, θ₀) in a/U_s, or None when the run ended before it settled."""
        return self.metadata.get("settling_time")

    @property
    def split(self) -> str:
        """Split of the data set: ``train``, ``A`` or ``B``."""
        return self.metadata["split"]

    @property
    def B(self) -> float:
        """Elasto-gravitational number."""
        return self.metadata["B"]

    @property
    def angle_index(self) -> int:
        """k of θ₀ = kπ/48."""
        return self.metadata["angle_index"]

    @property
    def theta0(self) -> float:
        """The inclination that it really started from, tilt included, in radians."""
        return self.metadata["scene"]["start_angle"]

    @property
    def name(self) -> str:
        """The name of this fall in messages."""
        return f"B = {self.B:g}, angle_index = {self.angle_index}"


def fall_keys(split: str, B: float, angle_index: int, theta0: float) -> dict:
    """Metadata that tell a fall of a data set from the others."""
    return {"split": split, "B": B, "angle_index": angle_index, "scene": {"start_angle": theta0}}
