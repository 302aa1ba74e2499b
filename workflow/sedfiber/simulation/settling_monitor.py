"""Whether a run has come to rest, and in which steady shape: the terminal U, or the W of a symmetric fall."""

import math

import numpy as np

from sedfiber.core.array_types import Positions, State
from sedfiber.core.errors import NumericalError
from sedfiber.physics.mirror import MirrorSymmetric
from sedfiber.physics.system import System
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.spectrum import leaving_rate, round_off
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.settling import CONFIRMED, SETTLED, distance_to_terminal

_STANDSTILL = 1e-9  # U_s: relative bead speeds below this mean that the shape is steady
_RESTING = 1e-5  # U_s: below this a shape may be compared with the W


class SettlingMonitor:
    """Looks at the states of a run of ``scene`` and knows the shapes that it may settle to.

    ``terminal`` (N, 3) is the terminal U relative to the centre bead, or None where the scene has
    none.  A run may do without one if it has an end of its own, or is exactly symmetric.
    """

    def __init__(self, scene: Scene, system: System | MirrorSymmetric, ends: bool, max_time: float):
        self._scene, self._system, self._max_time = scene, system, max_time
        self._symmetric = isinstance(system, MirrorSymmetric)
        self.terminal = self._terminal(needed=not (ends or self._symmetric))
        if not ends and self.terminal is not None:
            self._require_attraction(system.to_shapes(system.to_state(scene.start())))

    def is_over(self, t: float, y: State) -> bool:
        """Whether the run at time ``t`` has settled beyond doubt; raises NumericalError when it never will."""
        shape = self._system.to_shapes(y)
        distance = self._distance(shape, self.terminal)
        if distance < CONFIRMED:
            return True
        if t > self._max_time:
            raise NumericalError(f"not settled by t = {self._max_time:g} (distance {distance:.3g} L); give --t-end")
        if distance < SETTLED or np.abs(self._system.relative_velocities(y)).max() > _STANDSTILL:
            return False
        settled_to = self.settled_to(y, shape)
        if self._symmetric and settled_to is not None:
            return True
        name = "the unstable W" if settled_to == "W" else "a steady shape"
        raise NumericalError(
            f"came to rest at t = {t:g} in {name}, {distance:.3g} L from the terminal one; {self._way_out()}"
        )

    def _way_out(self) -> str:
        """Advice for a fiber that stays in a steady shape which it should leave."""
        if self._scene.shape is None and abs(self._scene.start_angle) == math.pi / 2:
            return "a vertical fiber falls along its axis: give another theta0, or --t-end"
        return "give --t-end, or a larger --tilt to leave a symmetric start"

    def settled_to(self, y: State, shape: Positions) -> str | None:
        """Name of the steady shape that ``shape`` (N, 3) of state ``y`` is within 1e-3 L of, or None.

        "U" if the run stays there, "W" if it rests there.
        """
        if self._distance(shape, self.terminal) < SETTLED:
            return "U" if self._leaving_rate(shape) < round_off(self._scene) else None
        if not self._scene.has_terminal_shape or np.abs(self._system.relative_velocities(y)).max() > _RESTING:
            return None
        try:
            w = terminal_state(self._scene, "W").positions
        except NumericalError:
            return None
        return "W" if self._distance(shape, w) < SETTLED else None

    def _leaving_rate(self, shape: Positions) -> float:
        """Largest rate in U_s/a at which a run that is at ``shape`` now can leave the terminal U."""
        assert self.terminal is not None  # callers have looked
        return leaving_rate(self._scene, self.terminal, self._symmetric, flat=not shape[:, 2].any())

    def _require_attraction(self, start: Positions) -> None:
        """A run without an end needs a terminal shape that it does not leave."""
        rate = self._leaving_rate(start)
        if rate >= round_off(self._scene) and not self._symmetric:
            raise NumericalError(
                f"at B={self._scene.B:g} the terminal U is unstable to what this run is free to do "
                f"(rate {rate:.3g} U_s/a), and it will not settle; give --t-end"
            )

    def _distance(self, shape: Positions, steady: Positions | None) -> float:
        """Root-mean-square bead distance to a steady shape over L; infinite where there is none."""
        return np.inf if steady is None else float(distance_to_terminal(shape, steady, self._scene.length))

    def _terminal(self, needed: bool) -> Positions | None:
        if not self._scene.has_terminal_shape:
            return None
        try:
            return terminal_state(self._scene).positions
        except NumericalError as error:
            if needed:
                raise NumericalError(f"{error}; give --t-end to simulate without settling") from None
            return None
