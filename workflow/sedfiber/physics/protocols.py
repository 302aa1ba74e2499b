"""The interfaces of a system's parts: forces, a mobility, flows.

Each part is one small class.  ``needs_lab_frame`` says which positions it is given: False for those
relative to the centre bead, all that a part without a place of its own depends on; True for
positions in the laboratory, which a wall or a flow needs.
"""

from collections.abc import Callable
from typing import Protocol

from sedfiber.core.array_types import Band, History, Matrix, Positions, State

TO_THE_LAST = 1 << 62  # end of a range of beads that reaches to the last one


class Force(Protocol):
    """Pushes on beads: adds to an array of forces and to its Jacobian.

    ``banded`` says that a force depends on beads at most two apart along the chain; then
    ``add_jacobian`` adds to a band (5, d, d, N), otherwise to a matrix (N d, N d).
    """

    @property
    def needs_lab_frame(self) -> bool: ...
    @property
    def banded(self) -> bool: ...
    def add_force(self, x: Positions, force: Positions) -> None: ...
    def add_jacobian(self, x: Positions, jac: Band | Matrix) -> None: ...


class ConservativeForce(Force, Protocol):
    """A force that is minus the gradient of an energy."""

    def energy(self, x: Positions) -> float: ...


class Mobility(Protocol):
    """Turns forces into velocities."""

    @property
    def needs_lab_frame(self) -> bool: ...

    def velocity(self, x: Positions, force: Positions, u: Positions) -> None:
        """Write ``M(x) F`` to ``u``."""

    def matrix(self, x: Positions) -> Matrix:
        """``M(x)``, shape (N d, N d)."""

    def linearise(self, x: Positions, force: Positions, band: Band, u: Positions, jac: Matrix) -> None:
        """Write ``M F`` to ``u`` and add ``M ∂F/∂x + (∂M/∂x) F`` to ``jac``, at least (N d, N d)."""


class Flow(Protocol):
    """Carries beads along: adds to their velocities, and to the Jacobian of these."""

    def add_velocity(self, x: Positions, u: Positions) -> None: ...

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``∂u/∂x`` to ``jac``, at least (N d, N d)."""


class Equations(Protocol):
    """What an integrator asks of equations ``ẏ = f(t, y)``; without a Jacobian LSODA takes differences."""

    @property
    def rhs_count(self) -> int: ...
    @property
    def jacobian_count(self) -> int: ...

    @property
    def jacobian(self) -> Callable[[float, State], Matrix] | None: ...

    def rhs(self, t: float, y: State) -> State: ...

    def loss_of_definiteness(self, y: State) -> tuple[str, str] | None:
        """Why no step may succeed at a state, and what to try, where the mobility is to blame."""


class BeadEquations(Equations, Protocol):
    """Equations of motion of beads: their states stand for positions."""

    @property
    def mobility(self) -> Mobility: ...

    def to_state(self, x: Positions) -> State: ...
    def to_positions(self, states: State) -> History: ...
