"""Steady shapes: Newton on the force balance in the frame that falls with the fiber.

The unknowns are the bead positions relative to the centre bead (planar, 2(N−1) of them),
the equations ``u_i(x) − u_c(x) = 0`` for every bead but the centre.  Translation is removed
by the frame and gravity fixes the orientation, so the Jacobian is regular on the U branch.
The branch is followed in ``log ℬ`` from the nearly straight state with a secant predictor.
"""

from dataclasses import dataclass, replace

import numpy as np

from sedfiber._typing import Array, Positions
from sedfiber.errors import InputError, NumericalError
from sedfiber.physics.assembly import assemble
from sedfiber.physics.system import System
from sedfiber.scene import Scene

NEARLY_STRAIGHT = 10.0  # ℬ from which the straight fiber is a good first guess
TOLERANCE = 1e-10  # on the largest relative bead speed, in U_s
_MAX_NEWTON = 12
_FIRST_STEP, _LAST_STEP = 0.2, 1e-4  # in log ℬ
_LARGEST_CORRECTION = 0.02  # of L, by which Newton may move a bead from the prediction
_LAST_CORRECTION = 1e-5  # of the height, by which the last Newton step may still move a bead
_POLISHED = 3  # converged iterates to choose from


@dataclass(frozen=True)
class SteadyState:
    """A shape that falls without changing.

    ``positions`` (N, 3) relative to the centre bead in units of a; ``velocity`` (3,) in U_s;
    ``residual`` is the largest speed of a bead relative to the centre bead.
    """

    B: float
    positions: Positions
    velocity: Array
    residual: float

    @property
    def height(self) -> float:
        """Vertical extent of the bead centres, in a."""
        return float(np.ptp(self.positions[:, 1]))

    @property
    def end_to_end(self) -> float:
        """Distance between the first and the last bead, in a."""
        return float(np.linalg.norm(self.positions[0] - self.positions[-1]))

    @property
    def speed(self) -> float:
        """Settling speed in U_s."""
        return float(np.linalg.norm(self.velocity))


def steady_state(B: float, n_beads: int = 31, hydrodynamics: str = "RPY") -> SteadyState:
    """Terminal U-shape and velocity at one elasto-gravitational number.

    Raises InputError for values that are not allowed and NumericalError when the branch
    cannot be followed to ``B``.
    """
    return terminal_state(Scene(B, 0.0, n_beads, hydrodynamics=hydrodynamics))


def terminal_state(scene: Scene) -> SteadyState:
    """Terminal U-shape and velocity of a scene that has one, with just its effects.

    Raises InputError for a scene without a terminal shape and NumericalError when the branch
    cannot be followed to its ℬ.
    """
    if not scene.has_terminal_shape:
        raise InputError("steady: this scene has no terminal shape; it needs gravity, a fiber of 3 beads or more, RPY")
    flat = replace(scene, space="plane", theta0=0.0, tilt=0.0, shape=None, disturbance=None)
    x = _follow_branch(replace(flat, B=min(scene.B, NEARLY_STRAIGHT)), scene.B)
    system = assemble(flat)
    velocity, residual = _relative_speeds(system, x)
    positions, fall = np.zeros((scene.n_beads, 3)), np.zeros(3)
    positions[:, :2], fall[:2] = x, velocity[system.centre]
    return SteadyState(scene.B, positions, fall, float(np.abs(residual).max()))


def _follow_branch(scene: Scene, target: float) -> Positions:
    """Continue in log ℬ, halving the step where Newton strays from the prediction."""
    at, goal, step = np.log(scene.B), np.log(target), _FIRST_STEP
    x, slope = _solve(scene, scene.start()), 0.0
    if x is None:
        raise NumericalError(
            f"steady: no nearly straight state found at B={scene.B:g} with {scene.n_beads} beads; "
            "a fiber so stiff is rigid and round-off hides its balance, try a larger B"
        )
    while at < goal:
        ahead = min(at + step, goal)
        predicted = x + slope * (ahead - at)
        found = _solve(replace(scene, B=float(np.exp(ahead))), predicted)
        if found is None or np.abs(found - predicted).max() > _LARGEST_CORRECTION * scene.length:
            step /= 2.0
            if step < _LAST_STEP:
                raise NumericalError(f"steady: the branch was lost near B={np.exp(at):.6g}")
            continue
        slope, x, at = (found - x) / (ahead - at), found, ahead
        step = min(_FIRST_STEP, 1.5 * step)
    return x


def _solve(scene: Scene, guess: Positions) -> Positions | None:
    """Newton from a guess to round-off; None when it does not get there.

    Converged means: the balance holds to the tolerance plus round-off, and the last step was
    a negligible part of the deflection (for a very stiff fiber round-off hides the balance).
    Of a few such iterates the one with the smallest residual is taken.
    """
    system = assemble(scene)
    # differences of coordinates of size N carry a round-off of eps·N, times the modulus
    noise = np.finfo(float).eps * scene.n_beads * scene.modulus
    x, converged = guess, []
    for _ in range(_MAX_NEWTON):
        _, residual = _relative_speeds(system, x)
        size = float(np.abs(residual).max())
        if not np.isfinite(size):
            return None
        step = _newton_step(system, x, residual)
        if size < TOLERANCE + noise and np.abs(step).max() < _LAST_CORRECTION * np.ptp(x[:, 1]):
            converged.append((size, x))
        if len(converged) == _POLISHED or (converged and size < 1e-2 * TOLERANCE):
            break
        x = x - step
    return min(converged, key=lambda pair: pair[0])[1] if converged else None


def _relative_speeds(system: System, x: Positions) -> tuple[Positions, Positions]:
    """Velocities (N, d), and the same relative to the centre bead's."""
    u = system.velocity(x)
    return u, u - u[system.centre]


def _newton_step(system: System, x: Positions, residual: Positions) -> Positions:
    """Correction (N, d) that leaves the centre bead at the origin."""
    n, d = system.shape
    jac = system.velocity_jacobian(x).reshape(n, d, n * d)
    relative = (jac - jac[system.centre]).reshape(n * d, n * d)
    keep = np.arange(n * d) // d != system.centre
    step = np.zeros(n * d)
    step[keep] = np.linalg.solve(relative[np.ix_(keep, keep)], residual.ravel()[keep])
    return step.reshape(n, d)
