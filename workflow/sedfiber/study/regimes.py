"""Rotation and bending of a fiber over a fall, and which of three regimes they make.

φ(s, t) is the inclination of the tangent, s the arclength from the centre in units of L, −½ ≤ s ≤ ½.

    turn of the mean tangent    ⟨φ⟩(0) − ⟨φ⟩(T)                      positive: clockwise; θ₀ for a fall that settles
    bend                        b(t) = max_s φ − min_s φ             π: the two ends point opposite ways
    apex                        a(t) = ∫ s κ² ds / ∫ κ² ds           κ = ∂φ/∂s; where along the fiber the bend is

A fiber that slides along its own line, φ(s, t) = Φ(s − a(t)), turns each of its pieces into the direction
of the next one and so turns its mean tangent without turning the line. This splits the turn in two:

    by sliding    ∫ [φ(½) − φ(−½)] (da/dt) dt
    as a whole    the rest: what is left to a fiber whose apex stays where it is

Three questions, in this order, name the regime:

    snaking     does the fiber bend over itself, b ≥ π, and then slide along itself, |a| > 1/N?
    rotation    if not: does it turn as a whole by more than each side bends, b(T)/2?
    bending     if neither

The second compares like with like: rotation turns both ends alike, bending turns each by b/2, towards each
other. The first has one threshold, the distance of two beads: a slide of less is none in a chain of beads.

Samples: φ is known for the N − 1 bonds, and bends at the N − 2 beads between them. Angles are in radians.
"""

from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import Array, History
from sedfiber.core.errors import InputError

REGIMES = ("rotation", "bending", "snaking")
STRAIGHT = 1e-9  # radians: fibers whose bonds turn by less, all taken together, are straight and have no apex


@dataclass(frozen=True)
class Motion:
    """One fall in numbers: angles in radians, places along the fiber in L, negative towards the first bead."""

    turned: float
    turned_whole: float
    turned_sliding: float
    bend_max: float
    bend_terminal: float
    apex_farthest: float  # from the centre, at any time
    slid_folded: float  # |a|, the greatest since b ≥ π for the first time; 0 for a fiber that never folds
    bond: float  # 1/N, the length of a bond

    @property
    def regime(self) -> str:
        """One of `REGIMES`."""
        if self.slid_folded > self.bond:
            return "snaking"
        return "rotation" if abs(self.turned_whole) > 0.5 * self.bend_terminal else "bending"


def measure_motion(positions: History) -> Motion:
    """Measure the rotation and bending of a fall in the xy-plane: ``positions`` (T, N, 3).

    Raises InputError for fewer than two samples or three beads.
    """
    if len(positions) < 2 or positions.shape[1] < 3:
        raise InputError(f"positions: {len(positions)} samples of {positions.shape[1]} beads; give 2 and 3, or more")
    tangents = _inclinations(positions)
    bends = np.ptp(tangents, axis=1)
    apexes = _apexes(tangents)
    turned = tangents[0].mean() - tangents[-1].mean()
    sliding = _turned_by_sliding(tangents, apexes)
    return Motion(
        turned=float(turned),
        turned_whole=float(turned - sliding),
        turned_sliding=float(sliding),
        bend_max=float(bends.max()),
        bend_terminal=float(bends[-1]),
        apex_farthest=float(apexes[np.abs(apexes).argmax()]),
        slid_folded=_slid_folded(bends, apexes),
        bond=1.0 / positions.shape[1],
    )


def _inclinations(positions: History) -> Array:
    """φ of every bond, (T, N − 1), without jumps by 2π along the fiber or in time."""
    bonds = np.diff(positions[..., :2], axis=1)
    return np.unwrap(np.unwrap(np.arctan2(bonds[..., 1], bonds[..., 0]), axis=1), axis=0)


def _apexes(tangents: Array) -> Array:
    """a(t) at every sample, (T,); a straight fiber's is that of the next sample that is bent, or of the last."""
    n_bonds = tangents.shape[1]
    places = (np.arange(1, n_bonds) - 0.5 * n_bonds) / (n_bonds + 1)
    weights = np.diff(tangents, axis=1) ** 2
    bent = np.flatnonzero(weights.sum(axis=1) > STRAIGHT**2)
    if not bent.size:
        return np.zeros(len(tangents))
    apexes = (weights[bent] @ places) / weights[bent].sum(axis=1)
    following = np.searchsorted(bent, np.arange(len(tangents))).clip(max=len(bent) - 1)
    return apexes[following]


def _turned_by_sliding(tangents: Array, apexes: Array) -> float:
    """∫ [φ(½) − φ(−½)] da by the trapezoidal rule.

    A slide by one bond, 1/N, passes one of the N − 1 inclinations out at one end and one in at the other.
    """
    n_bonds = tangents.shape[1]
    across = tangents[:, -1] - tangents[:, 0]
    slides = np.diff(apexes) * (n_bonds + 1) / n_bonds
    return float((0.5 * (across[1:] + across[:-1]) * slides).sum())


def _slid_folded(bends: Array, apexes: Array) -> float:
    folded = np.flatnonzero(bends >= np.pi)
    return float(np.abs(apexes[folded[0] :]).max()) if folded.size else 0.0
