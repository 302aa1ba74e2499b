"""After a run: would an effect that the scene left out have mattered?

Each is weighed from the trajectory where that is cheap, and gets one line: "left out, and it
does not matter (number)" or "left out, and it matters (number): add …".
"""

from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import History
from sedfiber.physics.gaps import closest_distance, smallest_gap
from sedfiber.physics.pair_forms import RPY, RPY_OVERLAP, coefficients
from sedfiber.scene.parts import Gravity
from sedfiber.scene.scene import Scene
from sedfiber.simulation.checks import largest_strain
from sedfiber.simulation.equilibria.transverse import transverse_rates
from sedfiber.simulation.recorded_run import Run

MOBILITY_CHANGE = 0.01  # relative change of a pair's mobility from which the overlap form matters
STRETCH = 0.05  # bond strain from which a fiber is no longer an inextensible one
AMPLIFIED = 100.0  # growth on the way from which out-of-plane disturbances matter, whatever the end
_STATES = 64  # states along the way at which transverse rates are taken


@dataclass(frozen=True)
class Verdict:
    """One effect that was left out: whether it matters, by what number, and what to add if it does."""

    effect: str
    matters: bool
    number: float
    meaning: str
    remedy: str

    @property
    def words(self) -> str:
        """The verdict in one line."""
        number = f"{self.number:.3g} {self.meaning}"
        if self.matters:
            return f"{self.effect}: left out, and it matters ({number}): add {self.remedy}"
        return f"{self.effect}: left out, and it does not matter ({number})"

    def to_dict(self) -> dict:
        """Plain values for a file's metadata."""
        return {"effect": self.effect, "matters": self.matters, "number": self.number, "words": self.words}


def audit(scene: Scene, run: Run) -> list[Verdict]:
    """Weigh what ``scene`` left out in its run."""
    shapes = np.ascontiguousarray(run.shapes[..., : scene.dim])
    found = []
    beads = scene.n_fibers * scene.n_beads
    if scene.hydrodynamics == "RPY" and beads > 1:
        found.append(_overlap_form(shapes))
    if scene.contact is None and beads > 2:
        found.append(_contact(shapes, scene.n_beads))
    if _may_leave_plane(scene):
        found.append(_third_dimension(scene, run))
    if scene.wall is None and scene.depth is not None and scene.gravity is not None:
        found.append(_bottom(scene.gravity, scene.depth, run.positions))
    if scene.wall is None and scene.flow is not None and scene.flow.half_width is not None:
        found.append(_channel(scene.flow.half_width, run.positions))
    strain = largest_strain(shapes, scene.n_beads)
    if scene.stretching is not None and strain is not None:
        found.append(_stretch(strain, scene.stretching.factor))
    return found


def _overlap_form(shapes: History) -> Verdict:
    """Plain RPY is one with the overlap form unless beads, neighbours too, are closer than 2a."""
    r = min(closest_distance(x) for x in shapes)
    plain, overlap = (_pair_speeds(r, form) for form in (RPY, RPY_OVERLAP))
    change = float(np.abs(plain / overlap - 1.0).max())
    meaning = f"relative change of a pair's mobility, closest centres {r:.4g} a apart"
    return Verdict("overlap form", change > MOBILITY_CHANGE, change, meaning, "hydrodynamics: RPY-overlap")


def _pair_speeds(r: float, form: int) -> np.ndarray:
    """Mobility of one bead by a force on another, across and along their line."""
    c1, e2, _, _ = coefficients(r * r, form)
    return np.array([c1, c1 + e2 * r * r])


def _contact(shapes: History, n_beads: int) -> Verdict:
    gap = min(smallest_gap(x, n_beads) for x in shapes)
    meaning = "a, smallest gap of beads that are not neighbours"
    return Verdict("contact", gap < 0.0, float(gap), meaning, "contact: {}")


def _may_leave_plane(scene: Scene) -> bool:
    """Planar scenes that also make sense in volume, and whose end is a state rather than a draw."""
    curved = scene.bending is not None and scene.bending.curvature != 0.0
    return scene.space == "plane" and scene.n_beads > 2 and scene.noise is None and not scene.own and not curved


def _third_dimension(scene: Scene, run: Run) -> Verdict:
    """Out-of-plane disturbances: their leading rate at the end, the largest along the way, and what it adds up to.

    The rates are those of a state held still, so their sum bounds the growth only roughly.
    """
    chosen = np.unique(np.linspace(0, len(run.t) - 1, _STATES).astype(int))
    rates = transverse_rates(scene, run.shapes[chosen], run.positions[chosen])
    growth = float(np.exp(min(np.trapezoid(np.maximum(rates, 0.0), run.t[chosen]), 700.0)))
    meaning = (
        f"U_s/a, leading out-of-plane rate at the end; {rates.max():.3g} at most along the way, "
        f"growth up to {growth:.2g} times"
    )
    remedy = "space: volume, with a disturbance"
    matters = bool(rates[-1] > 0.0 or growth > AMPLIFIED)
    return Verdict("third dimension", matters, float(rates[-1]), meaning, remedy)


def _bottom(gravity: Gravity, depth: float, positions: History) -> Verdict:
    """The depth that the lowest bead reached, over the stated depth."""
    down = positions @ np.array(gravity.direction)
    fall = float((down.max(axis=1) - down[0].max()).max()) / depth
    return Verdict("wall", fall > 1.0, fall, f"of the depth {depth:g} a fallen", "wall: {point: …}")


def _channel(half_width: float, positions: History) -> Verdict:
    """Beyond its half-width a parabolic flow turns back, where a channel has its walls."""
    furthest = float(np.abs(positions[..., 1]).max()) / half_width
    meaning = "of half_width, furthest that a bead got from y = 0"
    return Verdict("channel walls", furthest > 1.0, furthest, meaning, "wall: {point: …}")


def _stretch(strain: float, factor: float) -> Verdict:
    """The strain, which an inextensible model would not show."""
    meaning = "largest bond strain, which an inextensible fiber would not show"
    stiffer = f"stretching: {{factor: {10.0 * factor:g}}}, or beads"
    return Verdict("inextensibility", strain > STRETCH, strain, meaning, stiffer)
