"""A trajectory in memory: samples and what is known about how they were made."""

from dataclasses import dataclass, field

from sedfiber.core.array_types import History, Times


@dataclass(frozen=True)
class Trajectory:
    """``t`` (T,) in a/U_s, ``positions`` (T, beads, 3) in a, fiber after fiber, ``metadata`` of plain values.

    ``metadata`` holds the scene, both ℬ numbers, how the run was made, its counters, its
    checks and the settling time: deterministic facts only.
    """

    t: Times
    positions: History
    metadata: dict = field(default_factory=dict)

    def __repr__(self) -> str:
        kind, (samples, beads, _) = self.metadata.get("kind", "trajectory"), self.positions.shape
        scene = self.metadata.get("scene", {})
        values = "".join(f", {key}={scene[key]:g}" for key in ("B", "theta0") if key in scene)
        return f"<Trajectory: {kind}{values}, {samples} samples to t = {self.t[-1]:g} a/U_s, {beads} beads>"

    @property
    def n_beads(self) -> int:
        """Number of beads N of one fiber."""
        return self.metadata.get("scene", {}).get("n_beads", self.positions.shape[1])

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
