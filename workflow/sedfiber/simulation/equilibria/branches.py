"""The branches of steady states against ℬ: the U, the W, what lies between them, and the vertical fiber.

The curve of steady shapes is cut at its folds into sections along each of which ℬ grows.  The U starts
from the straight fiber; the W is found by an exactly symmetric fall, and followed through its fold
the curve gives the middle section.  Whether U and W are parts of one curve depends on the fiber.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from sedfiber.core.errors import NumericalError
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.spectrum import Spectrum, spectrum
from sedfiber.simulation.equilibria.steady import SteadyState, require_terminal_shape, state_of, straight_point, w_point
from sedfiber.simulation.equilibria.steady_curve import CurvePoint, SteadyCurve
from sedfiber.simulation.equilibria.vertical import vertical_state

Measure = Callable[[SteadyState], float]
Found = tuple[SteadyState, float]  # by root finding, and by how much of ℬ a second search differs
_FOLD = 1e-6  # a tangent that leans less than this towards ℬ is that of a fold
_ASIDE = 1e-5  # arclength to both sides of a fold from which it is sought again
_ROOT = 1e-13  # of ℬ
_BRACKET = (-1e-3, 7e-4)  # of log ℬ about a root: a second search starts there


@dataclass(frozen=True)
class Section:
    """A part of the curve of steady shapes, ``points`` in order of ℬ."""

    name: str
    scene: Scene
    curve: SteadyCurve
    points: Sequence[CurvePoint]

    @cached_property
    def states(self) -> list[SteadyState]:
        """The points as states."""
        return [self._state(point) for point in self.points]

    @cached_property
    def folds(self) -> list[Found]:
        """The ends at which the curve turns back in ℬ; the second search starts beside the fold."""
        folds = [end for end in (self.points[0], self.points[-1]) if abs(end.tangent[-1]) < _FOLD]
        return [(self._state(fold), self._fold_accuracy(fold)) for fold in folds]

    def state(self, B: float) -> SteadyState | None:
        """Solved to round-off between the two points nearest to ``B``; None beyond the ends."""
        for low, high in pairwise(self.points):
            if low.B * (1.0 - _ROOT) <= B <= high.B * (1.0 + _ROOT):
                return replace(self._state(self.curve.at(B, low, high)), B=B)
        return None

    def root(self, k: int, measure: Measure) -> Found:
        """Where ``measure`` is zero between states k and k + 1; the second search starts from the upper one."""
        ends = self.points[k], self.points[k + 1]
        found, again = (self.curve.crossing(*order, lambda p: measure(self._state(p))) for order in (ends, ends[::-1]))
        return self._state(found), abs(again.B / found.B - 1.0)

    def _fold_accuracy(self, fold: CurvePoint) -> float:
        before, after = (self.curve.ahead(fold, side) for side in (-_ASIDE, _ASIDE))
        if before is None or after is None:
            return float("nan")
        return abs(self.curve.fold(before, after).B / fold.B - 1.0)

    def _state(self, point: CurvePoint) -> SteadyState:
        return state_of(point, self.scene, self.name)


@dataclass(frozen=True)
class Vertical:
    """The straight fiber that falls along its axis, at ``grid`` values of ℬ."""

    scene: Scene
    grid: Sequence[float]
    name = "vertical"
    folds = ()

    @cached_property
    def states(self) -> list[SteadyState]:
        """The states at the grid's ℬ."""
        return [self.state(B) for B in self.grid]

    def state(self, B: float) -> SteadyState:
        """It exists at every ℬ."""
        return vertical_state(replace(self.scene, B=B))

    def root(self, k: int, measure: Measure) -> Found:
        """Where ``measure`` is zero between states k and k + 1, by log ℬ."""

        def search(low: float, high: float) -> float:
            return brentq(lambda log_B: measure(self.state(float(np.exp(log_B)))), low, high, xtol=_ROOT)

        found = search(*np.log(self.grid[k : k + 2]))
        again = search(*(found + aside for aside in _BRACKET))
        return self.state(float(np.exp(found))), abs(again - found)


Branch = Section | Vertical


def spectrum_of(branch: Branch, state: SteadyState) -> Spectrum:
    """All modes of a state of a branch, in the plane and out of it."""
    return spectrum(replace(branch.scene, B=state.B), state.positions)


def trace_sections(scene: Scene, B_min: float, B_max: float) -> tuple[list[Section], str]:
    """The sections U, W and middle as far as they go between two ℬ, and why there is no W if there is none.

    Raises InputError for a scene without a terminal shape and NumericalError where the curve is lost.
    """
    require_terminal_shape(scene)
    scene = replace(scene, B=B_max)
    curve = SteadyCurve(scene)
    U = next(_pieces(curve, straight_point(replace(scene, B=B_min), curve), B_min, B_max))
    sections = [Section("U", scene, curve, U)]
    try:
        seed = w_point(scene, curve)
    except NumericalError as error:
        return sections, str(error)
    up, down = (_facing(seed, side) for side in (1.0, -1.0))
    above, pieces = next(_pieces(curve, up, B_min, B_max)), _pieces(curve, down, B_min, B_max)
    below, middle = next(pieces), next(pieces, None)
    sections.append(Section("W", scene, curve, [*reversed(below), *above[1:]]))
    if middle is not None:
        sections.append(Section("middle", scene, curve, middle))
    return sections, ""


def _facing(point: CurvePoint, side: float) -> CurvePoint:
    """The same point with its tangent towards larger or smaller ℬ."""
    return CurvePoint(point.unknowns, side * np.sign(point.tangent[-1]) * point.tangent)


def _pieces(curve: SteadyCurve, seed: CurvePoint, B_min: float, B_max: float) -> Iterator[list[CurvePoint]]:
    """Yield the pieces of the curve between folds, from ``seed`` on, until ℬ leaves the range."""
    piece, last = [seed], seed
    for point in curve.follow(seed):
        if last.tangent[-1] * point.tangent[-1] < 0.0:
            fold = curve.fold(last, point)
            yield [*piece, fold]
            piece = [fold]
        piece.append(point)
        last = point
        if _is_outside(point, B_min, B_max):
            yield piece
            return


def _is_outside(point: CurvePoint, B_min: float, B_max: float) -> bool:
    """Whether the way ahead leads further out of the range."""
    return bool(point.tangent[-1] * (point.B - (B_max if point.tangent[-1] > 0.0 else B_min)) >= 0.0)
