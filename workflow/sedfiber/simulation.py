"""Run one scene and check the result."""

from dataclasses import asdict, dataclass

import numpy as np

from sedfiber._typing import Positions, State
from sedfiber.errors import NumericalError
from sedfiber.physics.assembly import assemble
from sedfiber.physics.checks import check
from sedfiber.physics.integrators import INTEGRATORS, March, Tolerances
from sedfiber.physics.settling import CONFIRMED, SETTLED, distance_to_terminal, settling_time
from sedfiber.physics.steady import steady_state
from sedfiber.physics.system import System
from sedfiber.scene import Scene
from sedfiber.trajectory import Trajectory
from sedfiber.validation import number_within, one_of, positive_number

# Against Radau at 1e-10, over a third of the study's runs: LSODA at 1e-8 is within 1.2e-6 L at
# all times and the fastest; BDF needs 1.4 and Radau 1.9 times as long for the same worst error.
DEFAULT_INTEGRATOR = "LSODA"
_LOOK_EVERY = 16  # samples between two looks at whether the run has settled
_STANDSTILL = 1e-9  # U_s: relative bead speeds below this mean that the shape is steady


@dataclass(frozen=True)
class Numerics:
    """How a scene is integrated.

    ``rtol`` and ``atol`` (in a) bound the local error of each coordinate; ``interval`` is
    the sample spacing τ and ``max_time`` the time by which a run without an end must have
    settled, both in a/U_s.  Raises InputError for any value that is not allowed.
    """

    integrator: str = DEFAULT_INTEGRATOR
    rtol: float = 1e-8
    atol: float = 1e-8
    interval: float = 0.5
    max_time: float = 1e5

    def __post_init__(self) -> None:
        one_of("integrator", self.integrator, INTEGRATORS)
        for key in ("rtol", "atol"):
            tolerance = number_within(key, getattr(self, key), 1e-13, 0.1, "a number from 1e-13 to 0.1")
            object.__setattr__(self, key, tolerance)
        for key in ("interval", "max_time"):
            object.__setattr__(self, key, positive_number(key, getattr(self, key)))

    def march(self, system: System) -> March:
        """The chosen integrator on ``system``."""
        return INTEGRATORS[self.integrator](system, Tolerances(self.rtol, self.atol))


def simulate(scene: Scene, numerics: Numerics | None = None, t_end: float | None = None) -> Trajectory:
    """Integrate a scene and sample it every τ.

    Without ``t_end`` the run goes on until the shape is within 1e-4 L of the terminal one and
    the record ends with the first sample after the settling time T(ℬ, θ₀).  With ``t_end`` it
    ends with the last sample at or before ``t_end``.  Raises NumericalError when the
    integrator fails, a check breaks its bound, or a run without ``t_end`` does not settle.
    """
    numerics = numerics or Numerics()
    if t_end is not None:
        t_end = positive_number("t_end", t_end)
    terminal = steady_state(scene.B, scene.n_beads, scene.hydrodynamics).positions
    system = assemble(scene)
    march = numerics.march(system)
    states = _run(march, scene, terminal, numerics, t_end)
    t = numerics.interval * np.arange(len(states))
    distance = distance_to_terminal(system.to_shapes(states), terminal, scene.length)
    settled = settling_time(t, distance)
    if t_end is None:
        keep = int(np.searchsorted(t, settled)) + 1
        t, states, distance = t[:keep], states[:keep], distance[:keep]
    checks = check(system, states, _strain_bound(scene), _gap_bound(scene), float(distance[-1]))
    checks.require()
    metadata = _metadata(scene, numerics, t_end, march) | {
        "checks": checks.to_dict(),
        "settling_time": settled,
    }
    return Trajectory(t, system.to_positions(states), metadata)


def _run(march: March, scene: Scene, terminal: Positions, numerics: Numerics, t_end: float | None) -> State:
    """Collect states (T, N d + 1) until ``t_end``, or until the run has settled beyond doubt."""
    last = np.inf if t_end is None else np.floor(t_end / numerics.interval * (1 + 1e-12))
    collected: list[State] = []
    for k, y in enumerate(march.states(march.system.to_state(scene.start()), numerics.interval)):
        collected.append(y)
        if k >= last:
            break
        look = t_end is None and k % _LOOK_EVERY == 0
        if look and _settled(march.system, y, terminal, scene, k * numerics.interval, numerics):
            break
    return np.array(collected)


def _settled(system: System, y: State, terminal: Positions, scene: Scene, t: float, how: Numerics) -> bool:
    """Near enough to the terminal shape to stop; raises when it never will be."""
    distance = float(distance_to_terminal(system.to_shapes(y), terminal, scene.length))
    if distance < CONFIRMED:
        return True
    if t > how.max_time:
        raise NumericalError(f"simulate: not settled by t = {how.max_time:g} (distance {distance:.3g} L); give --t-end")
    if distance > SETTLED and _is_steady(system, y):
        raise NumericalError(
            f"simulate: came to rest at t = {t:g} in a steady shape {distance:.3g} L from the terminal one; "
            "give --t-end, or a --tilt to leave an exactly symmetric start"
        )
    return False


def _is_steady(system: System, y: State) -> bool:
    return bool(np.abs(system.relative_velocities(y)).max() < _STANDSTILL)


def _strain_bound(scene: Scene) -> float:
    return scene.n_beads / scene.modulus


def _gap_bound(scene: Scene) -> float:
    """Plain RPY loses positive definiteness for a pair closer than 1.13 a; the overlap form never."""
    return -2.0 if scene.hydrodynamics == "RPY-overlap" else -0.8


def _metadata(scene: Scene, numerics: Numerics, t_end: float | None, march: March) -> dict:
    return {
        "kind": "simulation",
        **scene.facts(),
        "numerics": asdict(numerics) | {"t_end": t_end},
        "counters": asdict(march.counters),
    }
