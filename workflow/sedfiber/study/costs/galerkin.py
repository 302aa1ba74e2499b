"""POD–Galerkin: the equations of motion projected on the leading modes of the training shapes.

    X = c + X̄_term + (L/2) Φᵀz,    dz/dt = Φ (u − u_c)/(L/2),    dc/dt = u_c,    u = M(X) F(X)

with the modes Φ (r, 2N) in the plane and the centre bead's velocity u_c.  Nothing is learned but
the modes, and the whole right-hand side is evaluated at each step: what is saved are unknowns.
"""

import numpy as np

from sedfiber.core.array_types import Array, History, Matrix, Positions, State
from sedfiber.physics.system import System
from sedfiber.reduced.pod import ModalBasis


class PodGalerkin:
    """The projected equations of ``system`` about the terminal shape (N, 3); an integrator takes it for a System.

    A state is [z, c], (r + 2,).
    """

    def __init__(self, system: System, basis: ModalBasis, terminal: Positions):
        n, d = system.shape
        self._system, self._half_length = system, float(n)
        self._modes = np.ascontiguousarray(basis.modes.reshape(-1, n, 3)[:, :, :d].reshape(-1, n * d))
        self._terminal = terminal[:, :d]
        self._centre = slice(system.centre * d, (system.centre + 1) * d)
        self.rhs_count = self.jacobian_count = 0

    def to_state(self, x: Positions) -> State:
        """Positions (N, 2) to the state whose shape is nearest."""
        centre = x[self._system.centre]
        residual = (x - centre - self._terminal) / self._half_length
        return np.append(self._modes @ residual.ravel(), centre)

    def to_positions(self, states: State) -> History:
        """States (…, r + 2) to positions (…, N, 3)."""
        positions = np.zeros((*states.shape[:-1], len(self._terminal), 3))
        positions[..., :2] = self._shapes(states) + states[..., None, -2:]
        return positions

    def rhs(self, t: float, y: State) -> State:
        """``dy/dt`` (r + 2,)."""
        self.rhs_count += 1
        u = self._system.velocity(self._shapes(y)).ravel()
        return np.append(self._modes @ self._relative(u) / self._half_length, u[self._centre])

    def jacobian(self, t: float, y: State) -> Matrix:
        """``∂(dy/dt)/∂y`` (r + 2, r + 2); nothing depends on the centre."""
        self.jacobian_count += 1
        by_modes = self._system.velocity_jacobian(self._shapes(y)) @ self._modes.T
        jac = np.zeros((y.size, y.size))
        jac[:-2, :-2] = self._modes @ self._relative(by_modes)
        jac[-2:, :-2] = by_modes[self._centre] * self._half_length
        return jac

    def loss_of_definiteness(self, y: State) -> tuple[str, str] | None:
        """The answer of the whole system."""
        return self._system.loss_of_definiteness(self._system.to_state(self._shapes(y)))

    def _shapes(self, states: State) -> Array:
        residual = states[..., :-2] @ self._modes
        return residual.reshape(*states.shape[:-1], *self._terminal.shape) * self._half_length + self._terminal

    def _relative(self, rows: Array) -> Array:
        """Rows (2N, …) of all beads relative to the centre bead's."""
        centre = np.tile(rows[self._centre], (len(self._terminal),) + (1,) * (rows.ndim - 1))
        return rows - centre
