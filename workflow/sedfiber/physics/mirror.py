"""Exact left–right symmetry: a fiber that is its own mirror image, integrated and solved as its right half.

The mirror image ``x → −x`` with the order of the beads reversed maps motions onto motions.  A
state that is its own image stays so, but round-off does not know that and breaks the symmetry
where it is unstable (the W-shape at high ℬ).  Here the beads from the centre on are the unknowns
and the others their images, so the symmetry is exact by construction.
"""

import numpy as np

from sedfiber.core.array_types import Array, History, Matrix, Positions, State
from sedfiber.physics.protocols import Mobility
from sedfiber.physics.system import System


def whole(right: Array) -> Array:
    """Relative positions (..., N, d) from those of the centre bead and all after it, (..., (N + 1)/2, d)."""
    left = right[..., :0:-1, :].copy()
    left[..., 0] *= -1.0
    return np.concatenate([left, right], axis=-2)


class MirrorSymmetric:
    """The equations of ``system`` for the right half; offers an integrator all that a System does.

    A state has one row for the centre bead's position, one for each bead after it relative to
    the centre bead, and the work of all forces: ((N + 1)/2 d + 1,).
    """

    def __init__(self, system: System):
        self.system = system
        n, d = system.shape
        self.centre = n // 2
        self._rows = np.append(np.arange(self.centre * d, n * d), n * d)
        self._images = np.arange(self.centre * d).reshape(-1, d)[::-1].ravel()
        self._signs = np.tile([-1.0, *np.ones(d - 1)], self.centre)

    @property
    def mobility(self) -> Mobility:
        """That of the whole fiber."""
        return self.system.mobility

    @property
    def rhs_count(self) -> int:
        """Evaluations of the right-hand side."""
        return self.system.rhs_count

    @property
    def jacobian_count(self) -> int:
        """Evaluations of the Jacobian."""
        return self.system.jacobian_count

    def to_state(self, x: Positions) -> State:
        """Positions (N, d) that are their own image to the half's state."""
        return self.system.to_state(x)[self._rows]

    def to_shapes(self, states: State) -> History:
        """States to positions of all beads relative to the centre bead (..., N, 3)."""
        return self.system.to_shapes(self._whole_states(states))

    def to_positions(self, states: State) -> History:
        """States to positions of all beads (..., N, 3)."""
        return self.system.to_positions(self._whole_states(states))

    def energy(self, x: Positions) -> float:
        """That of the whole fiber at positions (N, d)."""
        return self.system.energy(x)

    def relative_velocities(self, y: State) -> Positions:
        """Velocities of all beads relative to the centre bead's, (N, d)."""
        return self.system.relative_velocities(self._whole_states(y))

    def loss_of_definiteness(self, y: State) -> tuple[str, str] | None:
        """The answer of the whole fiber's system."""
        return self.system.loss_of_definiteness(self._whole_states(y))

    def rhs(self, t: float, y: State) -> State:
        """``dy/dt`` of the half; the centre bead stays in the mirror."""
        rates = self.system.rhs(t, self._whole_states(y))[self._rows]
        rates[0] = 0.0
        return rates

    def jacobian(self, t: float, y: State) -> Matrix:
        """``∂(dy/dt)/∂y`` of the half: moving a bead moves its image."""
        jac = self.system.jacobian(t, self._whole_states(y))[self._rows]
        half = jac[:, self._rows]
        d = self.system.shape[1]
        half[:, d:-1] += self._signs * jac[:, self._images]
        half[0] = 0.0
        half[:, 0] = 0.0
        return half

    def _whole_states(self, states: State) -> State:
        """States of the half to states of the system."""
        d = self.system.shape[1]
        right = states[..., :-1].reshape(*states.shape[:-1], -1, d)
        everything = whole(right).reshape(*states.shape[:-1], -1)
        return np.concatenate([everything, states[..., -1:]], axis=-1)
