"""The equations of motion ``ẋ = M(x) F(x)`` of a list of effects, in the centre bead's frame.

A state ``y`` has N d + 1 entries.  The first N d have the shape of the positions: the row of
the centre bead holds its position ``c``, every other row a position relative to it.  Elastic
forces and pair mobilities depend on relative positions alone, so a fall of any length costs
no digits, and a tolerance relative to ``|c|`` never loosens the tolerance on the shape.  The
last entry is the work ``W = ∫ F·ẋ dt`` of the forces, which must equal the energy lost.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from sedfiber._typing import History, Matrix, Positions, State


class Force(Protocol):
    """One effect that pushes on beads: adds to an array of forces and to its Jacobian."""

    def add_force(self, x: Positions, force: Positions) -> None: ...
    def add_jacobian(self, x: Positions, jac: Matrix) -> None: ...
    def energy(self, x: Positions) -> float: ...


class Mobility(Protocol):
    """What turns forces into velocities."""

    def velocity(self, x: Positions, force: Positions) -> Positions: ...
    def matrix(self, x: Positions) -> Matrix: ...
    def jacobian(self, x: Positions, force: Positions, force_jac: Matrix) -> Matrix: ...


class System:
    """Right-hand side and Jacobian of exactly the listed effects, with counters."""

    def __init__(self, forces: Sequence[Force], mobility: Mobility, n_beads: int, dim: int):
        self.forces = tuple(forces)
        self.mobility = mobility
        self.shape = (n_beads, dim)
        self.centre = n_beads // 2
        self.rhs_count = 0
        self.jacobian_count = 0

    def to_state(self, x: Positions) -> State:
        """Positions (N, d) to a state (N d + 1,), no work done yet."""
        y = x - x[self.centre]
        y[self.centre] = x[self.centre]
        return np.append(y.ravel(), 0.0)

    def to_shapes(self, states: State) -> History:
        """States (..., N d + 1) to positions relative to the centre bead (..., N, 3)."""
        shapes = np.zeros((*states.shape[:-1], self.shape[0], 3))
        shapes[..., : self.shape[1]] = states[..., :-1].reshape(*states.shape[:-1], *self.shape)
        shapes[..., self.centre, :] = 0.0
        return shapes

    def to_positions(self, states: State) -> History:
        """States (..., N d + 1) to positions (..., N, 3), the third coordinate zero in the plane."""
        x = self.to_shapes(states)
        d, first = self.shape[1], self.centre * self.shape[1]
        x[..., :d] += states[..., None, first : first + d]
        return x

    def relative(self, y: State) -> Positions:
        """Bead positions relative to the centre bead, shape (N, d)."""
        x = y[:-1].reshape(self.shape).copy()
        x[self.centre] = 0.0
        return x

    def force(self, x: Positions) -> Positions:
        """Sum of the listed forces, shape (N, d)."""
        total = np.zeros(self.shape)
        for effect in self.forces:
            effect.add_force(x, total)
        return total

    def force_jacobian(self, x: Positions) -> Matrix:
        """``∂F/∂x``, shape (N d, N d)."""
        jac = np.zeros((x.size, x.size))
        for effect in self.forces:
            effect.add_jacobian(x, jac)
        return jac

    def velocity(self, x: Positions) -> Positions:
        """``M(x) F(x)``, shape (N, d)."""
        return self.mobility.velocity(x, self.force(x))

    def velocity_jacobian(self, x: Positions) -> Matrix:
        """``∂(M F)/∂x``, shape (N d, N d)."""
        return self.mobility.jacobian(x, self.force(x), self.force_jacobian(x))

    def rhs(self, t: float, y: State) -> State:
        """``dy/dt``: relative velocities, the centre bead's own, and the power ``F·ẋ``."""
        self.rhs_count += 1
        x = self.relative(y)
        force = self.force(x)
        u = self.mobility.velocity(x, force)
        out = np.empty(u.size + 1)
        out[-1] = np.vdot(force, u)
        rows = out[:-1].reshape(self.shape)
        np.subtract(u, u[self.centre], out=rows)
        rows[self.centre] = u[self.centre]
        return out

    def jacobian(self, t: float, y: State) -> Matrix:
        """``∂(dy/dt)/∂y``, shape (N d + 1, N d + 1).

        The columns of ``c`` vanish by translation invariance, those of ``W`` because nothing
        depends on it.
        """
        self.jacobian_count += 1
        n, d = self.shape
        x = self.relative(y)
        force, force_jac = self.force(x), self.force_jacobian(x)
        jac = self.mobility.jacobian(x, force, force_jac)
        out = np.zeros((n * d + 1, n * d + 1))
        out[-1, :-1] = self.mobility.velocity(x, force).ravel() @ force_jac + force.ravel() @ jac
        centre = slice(self.centre * d, (self.centre + 1) * d)
        rows = jac.reshape(n, d, n * d) - jac[centre]
        rows[self.centre] = jac[centre]
        out[:-1, :-1] = rows.reshape(n * d, n * d)
        out[:, centre] = 0.0
        return out

    def energy(self, x: Positions) -> float:
        """Elastic and gravitational energy together, in units of ``6πμaU_s · a``."""
        return sum(effect.energy(x) for effect in self.forces)
