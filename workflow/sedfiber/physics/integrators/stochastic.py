"""Brownian motion: ``dx = (M F + u∞) dt + kT ∇·M dt + √(2kT) M^{1/2} dW``, one scheme for all mobilities.

With ``L Lᵀ = M(x_n)`` and normal numbers ``W`` the random forces of one step are
``ξ = √(2kT/Δt) L⁻ᵀ W``.  They move the beads to a midpoint, and act from there:

    x̃       = x_n + (Δt/2) M(x_n) ξ
    (I − Δt J/2) (x_{n+1} − x_n) = Δt (M(x_n) F(x_n) + u∞(x_n) + M(x̃) ξ),      J = ∂(M F + u∞)/∂x

Fixman's midpoint gives the drift ``kT ∇·M`` on average without a divergence being computed (it
vanishes in unbounded fluid in volume, and does not near a wall or in a plane).  The implicit
midpoint keeps the equilibrium of stiff springs and bends, ``⟨U⟩ = kT/2`` a degree of freedom,
exact at any step in the linear limit, where an implicit Euler step would freeze them.  Weak order one.
Beyond that limit a step must be well below ``√(2/(kT ℰ))``: the kicks across a bond lengthen it by
about ``kT Δt``, which has to be little against its thermal stretch ``√(2kT/ℰ)``.
Sources: Ermak & McCammon 1978; Fixman 1978; implicit midpoint: Delong, Sun, Griffith,
Vanden-Eijnden & Donev 2014.
"""

from collections.abc import Iterator

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, lu_factor, lu_solve, solve_triangular

from sedfiber.core.array_types import Matrix, Positions, State
from sedfiber.physics.integrators.base import Integrator, Tolerances
from sedfiber.physics.system import System


class StochasticMidpoint(Integrator):
    """Fixed steps of ``step`` that divide the sampling interval; every random number is from ``seed``."""

    name = "stochastic-midpoint"
    system: System  # of whole fibers: noise breaks any symmetry

    def __init__(self, system: System, tolerances: Tolerances, temperature: float, step: float, seed: int):
        super().__init__(system, tolerances)
        self._temperature, self._step = temperature, step
        # a stream of its own: the start draws its tilt and disturbance from the seed itself
        self._random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))

    def states(self, start: State, interval: float) -> Iterator[State]:
        steps = round(interval / self._step)
        x, t = self._positions(start), 0.0
        yield start
        while True:
            for _ in range(steps):
                x = self._advance(x, t)
                t += interval / steps
                if not np.isfinite(x).all():
                    raise self.failed(t, "a bead position is not finite", "give a smaller noise.step")
            yield self.system.to_state(x)

    def _positions(self, y: State) -> Positions:
        return self.system.to_positions(y)[:, : self.system.shape[1]].copy()

    def _advance(self, x: Positions, t: float) -> Positions:
        """One step from laboratory positions (N, d)."""
        dt, system = self._step, self.system
        force = self._random_force(x, t)
        pushed = np.empty_like(x)
        system.mobility.velocity(x, force, pushed)
        system.mobility.velocity(x + 0.5 * dt * pushed, force, pushed)
        matrix = np.eye(x.size) - 0.5 * dt * system.velocity_jacobian(x)
        move = lu_solve(lu_factor(matrix, check_finite=False), dt * (system.velocity(x) + pushed).ravel())
        counters = self.counters
        counters.steps += 1
        counters.rhs += 1
        counters.jacobians += 1
        counters.factorisations += 2
        return x + move.reshape(x.shape)

    def _random_force(self, x: Positions, t: float) -> Positions:
        """``√(2kT/Δt) L⁻ᵀ W``, shape (N, d)."""
        lower = self._root(x, t)
        normal = self._random.standard_normal(x.size)
        scale = (2.0 * self._temperature / self._step) ** 0.5
        return scale * solve_triangular(lower, normal, lower=True, trans="T").reshape(x.shape)

    def _root(self, x: Positions, t: float) -> Matrix:
        """L in ``L Lᵀ = M(x)``; NumericalError where M is not positive definite."""
        try:
            return cho_factor(self.system.mobility.matrix(x), lower=True)[0]
        except (LinAlgError, ValueError):
            why = "the mobility is not positive definite"
            raise self.stuck(t, self.system.to_state(x), why, "give a smaller noise.step") from None
