"""The curve of steady shapes in (shape, log ℬ), by pseudo-arclength continuation.

Steady shapes that are their own mirror image solve ``r(h, λ) = 0``: the velocities of the beads
after the centre bead relative to its own, with ``h`` their relative positions and ``λ = log ℬ``.
Translation is removed by the frame, gravity fixes the orientation and the mirror symmetry leaves
no other neutral direction, so the curve is regular everywhere but for folds in ``λ``, which the
arclength ``ds² = |dh|²/(n L²) + dλ²`` passes without noticing.  Keller 1977.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from sedfiber.core.array_types import Array, Matrix, Positions
from sedfiber.core.errors import NumericalError
from sedfiber.physics.mirror import whole
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene

TOLERANCE = 1e-10  # on the largest relative bead speed, in U_s
_MAX_NEWTON = 12
_QUICK = 6  # Newton steps from the prediction; where it takes more, shorter steps along the curve may find nothing
_FIRST_STEP, _LONGEST_STEP, _LAST_STEP = 0.1, 0.25, 1e-6
_LARGEST_CORRECTION = 0.01  # of L, by which Newton may move a bead from the prediction
_LEAST_COSINE = 0.8  # of the angle between tangents one step apart; past a right angle the way back looks like ahead
_LAST_CORRECTION = 1e-5  # of the height, by which the last Newton step may still move a bead
_LAST_MOVE = 1e-6  # a, and of λ: the last Newton step on the curve
_POLISHED = 3  # converged iterates to choose from
_ROOT = 1e-13  # of the arclength, at which a crossing is called found
_NEAR = 1e-6  # arclength from which Newton finds the state at a given ℬ, beside a fold too


@dataclass(frozen=True)
class CurvePoint:
    """``unknowns`` (h, λ) of one steady shape, and the unit tangent there, both (K + 1,)."""

    unknowns: Array
    tangent: Array

    @property
    def B(self) -> float:
        """Elasto-gravitational number."""
        return float(np.exp(self.unknowns[-1]))

    @property
    def positions(self) -> Positions:
        """Bead positions relative to the centre bead, (N, 2)."""
        return _positions(self.unknowns[:-1])


class SteadyCurve:
    """Steady shapes of a planar scene at every ℬ; the scene's own ℬ and start do not matter."""

    def __init__(self, scene: Scene):
        self._scene = replace(scene, space="plane", theta0=0.0, tilt=0.0, shape=None, disturbance=None)
        self.n_beads = scene.n_beads
        self._size = scene.n_beads - 1  # unknowns of the half: two coordinates of (N − 1)/2 beads
        self._metric = np.append(np.full(self._size, 1.0 / (scene.n_beads * scene.length**2)), 1.0)

    def nearest(self, B: float, guess: Positions, direction: float = 1.0) -> CurvePoint | None:
        """The steady shape at ``B`` that Newton finds from ``guess`` (N, 2), or None; tangent toward ``direction``."""
        right = self._solve(B, guess[len(guess) // 2 + 1 :].ravel())
        if right is None:
            return None
        unknowns = np.append(right, np.log(B))
        towards = np.append(np.zeros(self._size), direction)
        return CurvePoint(unknowns, self._tangent(self._linearise(unknowns)[1], towards))

    def follow(self, point: CurvePoint) -> Iterator[CurvePoint]:
        """Points ever further along the tangent; raises NumericalError where Newton no longer finds the curve."""
        step = _FIRST_STEP
        while True:
            ahead = self.ahead(point, step, _QUICK)
            if ahead is None or self._strayed(point, step, ahead):
                step /= 2.0
                if step < _LAST_STEP:
                    raise NumericalError(f"the branch of steady shapes was lost near B={point.B:.6g}")
                continue
            yield ahead
            point, step = ahead, min(_LONGEST_STEP, 1.5 * step)

    def ahead(self, point: CurvePoint, step: float, most: int = _MAX_NEWTON) -> CurvePoint | None:
        """Where the curve meets the plane across the tangent at ``step``; None where Newton does not get there."""
        return self._correct(point.unknowns + step * point.tangent, self._metric * point.tangent, most)

    def crossing(
        self, point: CurvePoint, ahead: CurvePoint, measure: Callable[[CurvePoint], float], accuracy: float = _ROOT
    ) -> CurvePoint:
        """Where ``measure`` is zero between two points of the curve, by root finding along it to an arclength."""
        length = self._length(ahead.unknowns - point.unknowns)
        root = brentq(lambda u: measure(self._between(point, ahead, u)), 0.0, 1.0, xtol=accuracy / length)
        return self._between(point, ahead, root)

    def at(self, B: float, point: CurvePoint, ahead: CurvePoint) -> CurvePoint:
        """The point at ``B`` between two points of the curve, solved to round-off."""
        goal = float(np.log(B))
        near = min((point, ahead), key=lambda end: abs(end.unknowns[-1] - goal))
        if abs(near.unknowns[-1] - goal) > _ROOT:
            near = self.crossing(point, ahead, lambda p: p.unknowns[-1] - goal, _NEAR)
        found = self.nearest(B, near.positions)
        if found is None:
            raise NumericalError(f"the branch of steady shapes was lost near B={B:.6g}")
        return found

    def fold(self, point: CurvePoint, ahead: CurvePoint) -> CurvePoint:
        """The fold in ℬ between two points whose tangents point to opposite sides."""
        return self.crossing(point, ahead, lambda p: float(p.tangent[-1]))

    def _between(self, point: CurvePoint, ahead: CurvePoint, u: float) -> CurvePoint:
        """The point at the share ``u`` of the way: Newton from the cubic through both points and their tangents."""
        chord = ahead.unknowns - point.unknowns
        border = self._metric * chord
        slopes = [self._length(chord) * np.sign(border @ end.tangent) * end.tangent for end in (point, ahead)]
        bend = (1.0 - u) * (slopes[0] - chord) - u * (slopes[1] - chord)
        found = self._correct(point.unknowns + u * chord + u * (1.0 - u) * bend, border, _MAX_NEWTON)
        if found is None:
            raise NumericalError(f"the branch of steady shapes was lost near B={point.B:.6g}")
        return found

    def _correct(self, predicted: Array, border: Array, most: int) -> CurvePoint | None:
        """Newton within the plane across ``border`` (K + 1,); the tangent points to its side."""
        at = predicted
        for _ in range(most):
            residual, matrix = self._linearise(at)
            if not np.isfinite(residual).all():
                return None
            target = np.append(residual, border @ (at - predicted))
            try:
                correction = np.linalg.solve(np.vstack([matrix, border]), target)
            except np.linalg.LinAlgError:
                return None
            at = at - correction
            if np.abs(residual).max() < TOLERANCE + self._noise(at) and np.abs(correction).max() < _LAST_MOVE:
                return CurvePoint(at, self._tangent(matrix, border))
        return None

    def _length(self, step: Array) -> float:
        return float(np.sqrt(self._metric @ step**2))

    def _strayed(self, point: CurvePoint, step: float, ahead: CurvePoint) -> bool:
        """Whether Newton went so far from the prediction, or the curve turned so much, that it may lead elsewhere."""
        correction = (ahead.unknowns - point.unknowns - step * point.tangent)[:-1]
        turned = (self._metric * point.tangent) @ ahead.tangent < _LEAST_COSINE
        return bool(turned or np.abs(correction).max() > _LARGEST_CORRECTION * self._scene.length)

    def _tangent(self, matrix: Matrix, border: Array) -> Array:
        """The unit tangent with a positive product with ``border``."""
        tangent = np.linalg.solve(np.vstack([matrix, border]), np.append(np.zeros(self._size), 1.0))
        return tangent / self._length(tangent)

    def _linearise(self, unknowns: Array) -> tuple[Array, Matrix]:
        """``r`` (K,) and its derivatives by ``h`` and ``λ``, (K, K + 1)."""
        B = float(np.exp(unknowns[-1]))
        system, right = self._system(B), unknowns[:-1]
        residual = self._balance(system, right)
        # r is a constant plus a multiple of 1/ℬ, so its derivative by λ is twice what doubling ℬ changes
        doubled = self._balance(self._system(2.0 * B), right)
        return residual, np.column_stack([self._derivatives(system, right), 2.0 * (doubled - residual)])

    def _solve(self, B: float, right: Array) -> Array | None:
        """Newton at one ℬ to round-off; None when it does not get there.

        Converged means: the balance holds to the tolerance plus round-off, and the last step was
        a negligible part of the deflection (for a very stiff fiber round-off hides the balance).
        Of a few such iterates the one with the smallest residual is taken.
        """
        system, noise = self._system(B), self._noise(np.append(right, np.log(B)))
        converged: list[tuple[float, Array]] = []
        for _ in range(_MAX_NEWTON):
            residual = self._balance(system, right)
            size = float(np.abs(residual).max())
            if not np.isfinite(size):
                return None
            step = np.linalg.solve(self._derivatives(system, right), residual)
            height = max(right[1::2].max(), 0.0) - min(right[1::2].min(), 0.0)
            if size < TOLERANCE + noise and np.abs(step).max() < _LAST_CORRECTION * height:
                converged.append((size, right))
            if len(converged) == _POLISHED or (converged and size < 1e-2 * TOLERANCE):
                break
            right = right - step
        return min(converged, key=lambda pair: pair[0])[1] if converged else None

    def _balance(self, system: System, right: Array) -> Array:
        """``r`` (K,)."""
        u, c = system.velocity(_positions(right)), system.centre
        return (u[c + 1 :] - u[c]).ravel()

    def _derivatives(self, system: System, right: Array) -> Matrix:
        """``∂r/∂h`` (K, K); moving a bead moves its image."""
        n, c = system.shape[0], system.centre
        jac = system.velocity_jacobian(_positions(right)).reshape(n, 2, n, 2)
        relative = jac[c + 1 :] - jac[c]
        images = relative[:, :, c - 1 :: -1] * np.array([-1.0, 1.0]) if c else relative[:, :, :0]
        return (relative[:, :, c + 1 :] + images).reshape(self._size, self._size)

    def _system(self, B: float) -> System:
        return assemble(replace(self._scene, B=B))

    def _noise(self, unknowns: Array) -> float:
        """Round-off of the balance: coordinates of size N carry eps·N, times the stiffest modulus."""
        stiffest = self._scene.stiffening * self._scene.modulus_at(np.exp(unknowns[-1]))
        return float(np.finfo(float).eps * self._scene.n_beads * stiffest)


def _positions(right: Array) -> Positions:
    """All beads (N, 2) relative to the centre bead, from those after it, (K,)."""
    return whole(np.append([0.0, 0.0], right).reshape(-1, 2))
