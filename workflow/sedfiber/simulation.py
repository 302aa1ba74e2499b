"""Run one scene and check the result."""

import hashlib
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

from sedfiber._typing import Positions, State
from sedfiber.audit import audit
from sedfiber.errors import InputError, NumericalError
from sedfiber.numerics import Numerics
from sedfiber.physics.assembly import assemble
from sedfiber.physics.checks import check
from sedfiber.physics.integrators import March
from sedfiber.physics.settling import CONFIRMED, SETTLED, distance_to_terminal, settling_time
from sedfiber.physics.steady import terminal_state
from sedfiber.physics.system import System
from sedfiber.scene import Scene
from sedfiber.trajectory import Trajectory
from sedfiber.validation import positive_number

_LOOK_EVERY = 16  # samples between two looks at whether the run has settled
_STANDSTILL = 1e-9  # U_s: relative bead speeds below this mean that the shape is steady


def simulate(scene: Scene, numerics: Numerics | None = None, t_end: float | None = None) -> Trajectory:
    """Integrate a scene and sample it every τ.

    Without ``t_end``, here or in ``numerics``, a scene that has a terminal shape runs until it is
    within 1e-4 L of it, and the record ends with the first sample after the settling time
    T(ℬ, θ₀).  With ``t_end`` it ends with the last sample at or before ``t_end``.  Raises
    InputError when a scene without a terminal shape is given no end, NumericalError when the
    integrator fails, a check breaks its bound, or a run without an end does not settle.
    """
    numerics = (numerics or Numerics()).for_scene(scene)
    if t_end is not None:
        numerics = replace(numerics, t_end=positive_number("t_end", t_end))
    if numerics.t_end is None and not scene.has_terminal_shape:
        raise InputError("t_end: missing; this scene has no terminal shape to settle to, give a time to end at")
    system = assemble(scene)
    march = numerics.march(system, scene)
    terminal = _terminal_shape(scene, needed=numerics.t_end is None)
    states = _run(march, scene, terminal, numerics)
    t = numerics.interval * np.arange(len(states))
    settled = distance = None
    if terminal is not None:
        history = distance_to_terminal(system.to_shapes(states), terminal, scene.length)
        settled = settling_time(t, history)
        if numerics.t_end is None:
            keep = int(np.searchsorted(t, settled)) + 1
            t, states, history = t[:keep], states[:keep], history[:keep]
        distance = float(history[-1])
    checks = check(system, states, scene, distance)
    checks.require()
    metadata = _metadata(scene, numerics, march) | {
        "checks": checks.to_dict(),
        "settling_time": settled,
        "audit": [verdict.to_dict() for verdict in audit(scene, system, t, states)],
    }
    return Trajectory(t, system.to_positions(states), metadata)


def _terminal_shape(scene: Scene, needed: bool) -> Positions | None:
    """The steady shape of a scene that has one; where none is found, a run with an end of its own does without."""
    if not scene.has_terminal_shape:
        return None
    try:
        return terminal_state(scene).positions
    except NumericalError:
        if needed:
            raise
        return None


def _run(march: March, scene: Scene, terminal: Positions | None, numerics: Numerics) -> State:
    """Collect states (T, beads d + 1) until the end, or until the run has settled beyond doubt."""
    t_end = numerics.t_end
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


def _metadata(scene: Scene, numerics: Numerics, march: March) -> dict:
    facts = {
        "kind": "simulation",
        **scene.facts(),
        "numerics": asdict(numerics),
        "counters": asdict(march.counters),
    }
    own = {part.file: hashlib.sha256(Path(part.file).read_bytes()).hexdigest() for part in scene.own}
    return facts | {"own_sha256": own} if own else facts
