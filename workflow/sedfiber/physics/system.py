"""The equations of motion ``ẋ = M(x) F(x) + u∞(x)`` of a list of parts, in the centre bead's frame.

A state ``y`` has N d + 1 entries.  The first N d have the shape of the positions: the row of
the centre bead holds its position ``c``, every other row a position relative to it.  Elastic
forces and pair mobilities depend on relative positions alone, so a fall of any length costs
no digits, and a tolerance relative to ``|c|`` never loosens the tolerance on the shape.  The
last entry is the work ``W = ∫ F·ẋ dt`` of the conservative forces, which must equal the energy lost.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from sedfiber.core.array_types import Band, History, Matrix, Positions, State
from sedfiber.physics import frame
from sedfiber.physics.definiteness import OVERLAP_REMEDY, indefinite_words, wall_blame
from sedfiber.physics.protocols import ConservativeForce, Flow, Force, Mobility


class System:
    """Right-hand side and Jacobian of exactly the listed parts, with counters.

    ``forces`` are conservative; ``nonconservative`` are forces without an energy, whose work is not counted.
    """

    def __init__(
        self,
        forces: Sequence[ConservativeForce],
        mobility: Mobility,
        n_beads: int,
        dim: int,
        nonconservative: Sequence[Force] = (),
        flows: Sequence[Flow] = (),
    ):
        self.forces, self.nonconservative, self.flows = tuple(forces), tuple(nonconservative), tuple(flows)
        self.mobility = mobility
        self.shape = (n_beads, dim)
        self._size = n_beads * dim + 1
        self._move, self._moves_in_lab_frame = mobility.velocity, mobility.needs_lab_frame
        # looked up once: attributes of parts are a tenth of a right-hand side
        self._add_force = tuple((part.add_force, part.needs_lab_frame) for part in forces)
        self._room = tuple(np.empty(self.shape) for _ in range(3))
        self.centre = n_beads // 2
        needs = [mobility.needs_lab_frame, *(part.needs_lab_frame for part in (*forces, *nonconservative))]
        self.needs_lab_frame = bool(flows) or any(needs)
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

    def rhs(self, t: float, y: State) -> State:
        """``dy/dt``: relative velocities, the centre bead's own, and the power ``F·ẋ``."""
        self.rhs_count += 1
        x, place, force, total, u = self._open(y)
        self._move(place if self._moves_in_lab_frame else x, total, u)
        for flow in self.flows:
            flow.add_velocity(place, u)
        out = np.empty(self._size)
        frame.rates(u, force, out)
        return out

    def jacobian(self, t: float, y: State) -> Matrix:
        """``∂(dy/dt)/∂y``, shape (N d + 1, N d + 1); nothing depends on the work."""
        self.jacobian_count += 1
        x, place, force, total, u = self._open(y)
        jac = np.zeros((y.size, y.size))
        band, far = self._linearise(x, place, total, u, jac)
        frame.add_work_row(u, force, band, jac)
        if far is not None:
            jac[-1, :-1] += u.ravel() @ far
        frame.to_centre_frame(jac, self.shape, self.needs_lab_frame)
        return jac

    def relative_velocities(self, y: State) -> Positions:
        """Bead velocities relative to the centre bead's at a state, shape (N, d)."""
        x, place, _, total, u = self._open(y)
        self._velocity(x, place, total, u)
        return u - u[self.centre]

    def force(self, x: Positions) -> Positions:
        """Sum of all forces at laboratory positions (N, d)."""
        force = np.zeros(self.shape)
        for part in (*self.forces, *self.nonconservative):
            part.add_force(x, force)
        return force

    def velocity(self, x: Positions) -> Positions:
        """``M(x) F(x) + u∞(x)`` at laboratory positions (N, d)."""
        u = np.empty(self.shape)
        self._velocity(x, x, self.force(x), u)
        return u

    def velocity_jacobian(self, x: Positions) -> Matrix:
        """``∂(M F + u∞)/∂x`` at laboratory positions, shape (N d, N d)."""
        jac = np.zeros((x.size, x.size))
        self._linearise(x, x, self.force(x), np.empty(self.shape), jac)
        return jac

    def energy(self, x: Positions) -> float:
        """Energy of all conservative forces at laboratory positions, in units of ``6πμaU_s · a``."""
        return sum(part.energy(x) for part in self.forces)

    def loss_of_definiteness(self, y: State) -> tuple[str, str] | None:
        """Why the mobility has lost its meaning at a state, naming beads, and what to try; None where it has not."""
        x = self.to_positions(y)[:, : self.shape[1]]
        if blame := wall_blame(self.mobility, x):
            return blame
        words = indefinite_words(self.mobility, x)
        return None if words is None else (words, OVERLAP_REMEDY)

    def _open(self, y: State) -> tuple[Positions, Positions, Positions, Positions, Positions]:
        """Open a state: positions relative to the centre bead, in the laboratory (the same array if no
        part needs that frame), conservative forces, all forces, room for velocities; all (N, d) and good
        until the next call.
        """
        x, force, u = self._room
        frame.open_state(y, x, force)
        place = self._in_laboratory(x, y) if self.needs_lab_frame else x
        for add_force, needs_lab_frame in self._add_force:
            add_force(place if needs_lab_frame else x, force)
        return x, place, force, self._with_nonconservative(x, place, force) if self.nonconservative else force, u

    def _in_laboratory(self, x: Positions, y: State) -> Positions:
        first = self.centre * self.shape[1]
        return x + y[first : first + self.shape[1]]

    def _with_nonconservative(self, x: Positions, place: Positions, force: Positions) -> Positions:
        total = force.copy()
        for part in self.nonconservative:
            part.add_force(place if part.needs_lab_frame else x, total)
        return total

    def _velocity(self, x: Positions, place: Positions, force: Positions, u: Positions) -> None:
        self._move(place if self._moves_in_lab_frame else x, force, u)
        for flow in self.flows:
            flow.add_velocity(place, u)

    def _linearise(
        self, x: Positions, place: Positions, force: Positions, u: Positions, jac: Matrix
    ) -> tuple[Band, Matrix | None]:
        """Write ``ẋ`` to ``u`` and add ``∂ẋ/∂x`` to ``jac``; returns ``∂F/∂x`` of the conservative forces."""
        band, far = self._force_jacobian(self.forces, x, place)
        all_band, all_far = band, far
        if self.nonconservative:
            drive_band, drive_far = self._force_jacobian(self.nonconservative, x, place)
            all_band = band + drive_band
            all_far = far if drive_far is None else drive_far if far is None else far + drive_far
        at, size = place if self.mobility.needs_lab_frame else x, x.size
        self.mobility.linearise(at, force, all_band, u, jac)
        if all_far is not None and all_far.any():  # contact is zero most of the time
            jac[:size, :size] += self.mobility.matrix(at) @ all_far
        for flow in self.flows:
            flow.add_velocity(place, u)
            flow.add_jacobian(place, jac)
        return band, far

    def _force_jacobian(self, parts: Iterable[Force], x: Positions, place: Positions) -> tuple[Band, Matrix | None]:
        """``∂F/∂x`` of some forces: the banded ones together, and the others if there are any."""
        band, far = frame.no_band(self.shape), None
        for part in parts:
            at = place if part.needs_lab_frame else x
            if part.banded:
                part.add_jacobian(at, band)
            else:
                far = np.zeros((x.size, x.size)) if far is None else far
                part.add_jacobian(at, far)
        return band, far
