"""Steady shapes that fall without changing: the terminal U, and the W of the symmetric fall at high ℬ.

The U-shape is followed along ``steady_curve`` from the nearly straight fiber.  The W-shape is what
an exactly symmetric fiber settles onto at high ℬ; it is unstable to left–right asymmetry and ends
towards low ℬ in a fold.  For N = 31 the two are ends of one S-shaped curve, for other N they need not be.
"""

from dataclasses import dataclass, replace

import numpy as np

from sedfiber.core.array_types import Array, Positions
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.core.validation import one_of
from sedfiber.physics.integrators import LSODA, Tolerances
from sedfiber.physics.mirror import MirrorSymmetric
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady_curve import CurvePoint, SteadyCurve

BRANCHES = ("U", "W")
NEARLY_STRAIGHT = 10.0  # ℬ from which the straight fiber is a good first guess
_FALLS = (1.0, 2.0, 4.0, 8.0)  # times ℬ = 10000, where symmetric falls are tried for a W
_ROUGHLY_STEADY = 1e-6  # U_s: relative bead speeds from which Newton takes over
_LONGEST_FALL = 100.0  # a/U_s a bead
_APART = 1e-2  # of L: shapes that differ by more are two states


@dataclass(frozen=True)
class SteadyState:
    """A shape that falls without changing.

    ``positions`` (N, 3) relative to the centre bead in units of a; ``velocity`` (3,) in U_s;
    ``residual`` is the largest speed of a bead relative to the centre bead; ``branch`` is "U" or "W".
    """

    B: float
    positions: Positions
    velocity: Array
    residual: float
    branch: str = "U"

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


def steady_state(B: float, n_beads: int = 31, hydrodynamics: str = "RPY", branch: str = "U") -> SteadyState:
    """Shape and velocity at one elasto-gravitational number: the terminal U, or the unstable W.

    Raises InputError for values that are not allowed and NumericalError when the branch
    does not reach ``B``, with the ℬ of the fold it ends in.
    """
    return terminal_state(Scene(B, 0.0, n_beads, hydrodynamics=hydrodynamics), branch)


def terminal_state(scene: Scene, branch: str = "U") -> SteadyState:
    """Steady shape and velocity of a scene that has one, with just its effects.

    Raises InputError for a scene without a terminal shape and NumericalError when the branch
    does not reach its ℬ.
    """
    one_of("branch", branch, BRANCHES)
    require_terminal_shape(scene)
    curve = SteadyCurve(scene)
    seed = straight_point(scene, curve) if branch == "U" else w_point(scene, curve)
    state = state_of(_reach(curve, seed, scene.B, branch), scene, branch)
    return replace(state, B=scene.B)  # not what its logarithm makes of it


def require_terminal_shape(scene: Scene) -> None:
    """Raises InputError for a scene without one."""
    if not scene.has_terminal_shape:
        raise InputError("this scene has no terminal shape; it needs gravity, a fiber of 3 beads or more, RPY")


def state_of(point: CurvePoint, scene: Scene, branch: str) -> SteadyState:
    """A point of the steady curve as a state, with its velocity and residual."""
    system = assemble(replace(planar(scene), B=point.B))
    velocity = system.velocity(point.positions)
    residual = velocity - velocity[system.centre]
    positions, fall = np.zeros((scene.n_beads, 3)), np.zeros(3)
    positions[:, :2], fall[:2] = point.positions, velocity[system.centre]
    return SteadyState(point.B, positions, fall, float(np.abs(residual).max()), branch)


def planar(scene: Scene) -> Scene:
    """The same effects on a straight, horizontal, exactly symmetric fiber in the plane."""
    return replace(scene, space="plane", theta0=0.0, tilt=0.0, shape=None, disturbance=None)


def straight_point(scene: Scene, curve: SteadyCurve) -> CurvePoint:
    """The start of the U branch: a nearly straight shape at ℬ = 10, or at the scene's if that is less."""
    B = min(scene.B, NEARLY_STRAIGHT)
    point = curve.nearest(B, planar(scene).start())
    if point is None:
        assert scene.stretching is not None  # or it would have no terminal shape
        raise NumericalError(
            f"no terminal shape found for B={scene.B:g}, {scene.n_beads} beads and "
            f"stretching.factor {scene.stretching.factor:g}: no nearly straight one at B={B:g} to follow from"
        )
    return point


def w_point(scene: Scene, curve: SteadyCurve) -> CurvePoint:
    """A point of the W branch near the scene's ℬ, from the exactly symmetric fall of a straight fiber.

    Raises NumericalError where such falls find the U, or nothing.
    """
    towards = NEARLY_STRAIGHT * 1e3
    for factor in _FALLS:
        B = towards * factor
        fallen = _symmetric_fall(replace(planar(scene), B=B))
        point = None if fallen is None else curve.nearest(B, fallen, np.sign(scene.B - B) or 1.0)
        if point is not None and not _is_U(point, scene):
            return point
    raise NumericalError(
        f"no W found with {scene.n_beads} beads; from B={towards:g} to {towards * _FALLS[-1]:g} "
        "symmetric fibers settle onto the U, or collapse"
    )


def _symmetric_fall(scene: Scene) -> Positions | None:
    """Where an exactly symmetric fiber comes to rest, (N, 2); None when it does not, or only with beads collapsed."""
    system = MirrorSymmetric(assemble(scene))
    interval = 20.0
    integrator = LSODA(system, Tolerances(1e-8, 1e-8))
    try:
        for k, y in enumerate(integrator.states(system.to_state(scene.start()), interval)):
            if k and np.abs(system.relative_velocities(y)).max() < _ROUGHLY_STEADY:
                return None if system.loss_of_definiteness(y) else system.to_shapes(y)[:, :2]
            if k * interval > _LONGEST_FALL * scene.n_beads:
                break
    except NumericalError:  # few beads collapse where plain RPY is not positive definite
        pass
    return None


def _is_U(point: CurvePoint, scene: Scene) -> bool:
    """Whether the terminal U at the point's ℬ exists and is this shape."""
    try:
        terminal = terminal_state(replace(scene, B=point.B)).positions[:, :2]
    except NumericalError:
        return False
    return bool(np.sqrt(((point.positions - terminal) ** 2).sum(axis=1).mean()) < _APART * scene.length)


def _reach(curve: SteadyCurve, seed: CurvePoint, B: float, branch: str) -> CurvePoint:
    """The point of a branch at ``B``, polished; raises NumericalError where a fold ends the branch before."""
    goal, last = float(np.log(B)), seed
    side = np.sign(goal - seed.unknowns[-1])
    if side == 0.0:
        return seed
    for point in curve.follow(seed):
        if side * point.tangent[-1] <= 0.0:
            point = curve.fold(last, point)
            if side * (point.unknowns[-1] - goal) < 0.0:
                raise NumericalError(
                    f"there is no {branch} at B={B:g}; with {curve.n_beads} beads it ends in a fold at B={point.B:.6g}"
                )
        if side * (point.unknowns[-1] - goal) >= 0.0:
            break
        last = point
    return curve.at(B, last, point)
