"""The paper's set-up, as a reader of its text would write it in NumPy: the yardstick of what it costs.

N beads in three dimensions with absolute positions X (N, 3), 3N unknowns,

    dX/dt = M F,    F = −∂/∂X ℰ [Σ_bonds (r/2 − 1)² + (1/8) Σ_angles (1 − cos θ)] − ŷ,
    M_ij = (3/4r + 1/2r³) I + (3/4r − 3/2r³) r̂ r̂ᵀ,    M_ii = I,

the mobility as a full (3N, 3N) matrix, and ``scipy.integrate.ode('dopri5')`` called once for each
sample.  The paper states no tolerances: they are SciPy's own (rtol 1e-6, atol 1e-12), and so
are all other settings.  With these a call gives up after 500 steps; it is then made again from
where it stopped, as often as the sample needs.  The equations are those of ``physics``; nothing
is shared with it.
"""

import time
import warnings
from dataclasses import dataclass

import numpy as np
from scipy.integrate import ode

from sedfiber.core.array_types import Array, History, Matrix, Positions
from sedfiber.core.errors import NumericalError

RTOL = 1e-6  # dopri5's own; atol is 1e-12
_OUT_OF_STEPS = -2


@dataclass(frozen=True)
class SourceRun:
    """Positions (T, N, 3) of the samples reached, what they took in seconds, and what the integrator counted."""

    positions: History
    seconds: float
    rhs: int
    steps: int


class SourceSetup:
    """The right-hand side for N beads of one modulus ℰ, and its integration."""

    def __init__(self, modulus: float):
        self.modulus = modulus
        self._rhs = self._steps = 0

    def rhs(self, t: float, y: Array) -> Array:
        """``dX/dt`` (3N,)."""
        self._rhs += 1
        x = y.reshape(-1, 3)
        return mobility(x) @ forces(x, self.modulus).ravel()

    def run(self, start: Positions, samples: int, interval: float = 0.5, seconds: float = np.inf) -> SourceRun:
        """Integrate from ``start`` (N, 3) to the last of ``samples``, or to the first after ``seconds`` have gone."""
        self._rhs = self._steps = 0
        begun = time.perf_counter()
        solver = ode(self.rhs).set_integrator("dopri5")
        solver.set_solout(self._count_step)
        solver.set_initial_value(start.ravel(), 0.0)
        positions = [start]
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="dopri5: ")  # what a call gives up with is looked at instead
            while len(positions) < samples and time.perf_counter() - begun < seconds:
                positions.append(self._advance(solver, len(positions) * interval).reshape(-1, 3))
        return SourceRun(np.array(positions), time.perf_counter() - begun, self._rhs, self._steps)

    def _advance(self, solver: ode, t: float) -> Array:
        """The state at ``t``, however many calls that takes."""
        while True:
            self._steps -= 1  # each call reports its start as a step
            y = solver.integrate(t)
            code = solver.get_return_code()
            if code > 0:
                return y
            if code != _OUT_OF_STEPS:
                raise NumericalError(f"source: dopri5 gave up at t = {solver.t:.6g} a/U_s (return code {code})")

    def _count_step(self, t: float, y: Array) -> None:
        self._steps += 1


def forces(x: Positions, modulus: float) -> Positions:
    """Springs, bending and weight (N, 3)."""
    bonds = np.diff(x, axis=0)
    r = np.linalg.norm(bonds, axis=1)[:, None]
    t = bonds / r
    pull = modulus * (r / 2 - 1) * t
    cos = np.sum(t[:-1] * t[1:], axis=1)[:, None]
    before = modulus / 8 * (t[1:] - cos * t[:-1]) / r[:-1]  # ℰ/8 times ∂cos θ/∂(bond before the angle), and after it
    after = modulus / 8 * (t[:-1] - cos * t[1:]) / r[1:]
    f = np.zeros_like(x)
    f[:, 1] = -1.0
    f[:-1] += pull
    f[1:] -= pull
    f[:-2] -= before
    f[1:-1] += before - after
    f[2:] += after
    return f


def mobility(x: Positions) -> Matrix:
    """The Rotne–Prager matrix (3N, 3N)."""
    n = len(x)
    apart = x[:, None, :] - x[None, :, :]
    r = np.sqrt(np.sum(apart**2, axis=2)) + np.eye(n)  # a bead is no distance from itself
    unit = apart / r[:, :, None]
    across = 3 / (4 * r) + 1 / (2 * r**3)
    along = 3 / (4 * r) - 3 / (2 * r**3)
    blocks = across[:, :, None, None] * np.eye(3)
    blocks += along[:, :, None, None] * unit[:, :, :, None] * unit[:, :, None, :]
    blocks[range(n), range(n)] = np.eye(3)
    return blocks.swapaxes(1, 2).reshape(3 * n, 3 * n)
