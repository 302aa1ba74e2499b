"""Run one scene, check the result, and on request estimate its error."""

import hashlib
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from sedfiber.core.array_types import Positions, State
from sedfiber.core.errors import InputError
from sedfiber.core.validation import positive_number
from sedfiber.physics.integrators import Integrator
from sedfiber.physics.mirror import MirrorSymmetric
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.audit import audit
from sedfiber.simulation.checks import check
from sedfiber.simulation.error_estimate import estimate_error, needs_estimate
from sedfiber.simulation.recorded_run import Run
from sedfiber.simulation.settling import distance_to_terminal, settling_time
from sedfiber.simulation.settling_monitor import SettlingMonitor
from sedfiber.simulation.trajectory import Trajectory

_LOOK_EVERY = 16  # samples between two looks at whether the run has settled


class Watcher(Protocol):
    """Is told the time of every sample, and the time of the end where that is known, in a/U_s."""

    def __call__(self, t: float, t_end: float | None, /) -> None: ...


def simulate(
    scene: Scene, numerics: Numerics | None = None, t_end: float | None = None, progress: Watcher | None = None
) -> Trajectory:
    """Integrate a scene and sample it every τ.

    Without ``t_end``, here or in ``numerics``, a scene that has a terminal shape runs until it is
    within 1e-4 L of it, and the record ends with the first sample after the settling time
    T(ℬ, θ₀).  With ``t_end`` it ends with the last sample at or before ``t_end``.  An exactly
    symmetric scene (``tilt = 0``) stays so to the last bit and may settle onto the W instead;
    ``settled_to`` in the metadata says what it settled to.  ``progress`` follows a long run.  Raises
    InputError when a scene without a terminal shape is given no end, NumericalError when the
    integrator fails, a check breaks its bound, a run without an end does not settle, or the
    estimated error of a run at loose tolerances is out of proportion to them.
    """
    numerics = (numerics or Numerics()).for_scene(scene)
    if t_end is not None:
        numerics = replace(numerics, t_end=positive_number("t_end", t_end))
    if numerics.t_end is None and not scene.has_terminal_shape:
        raise InputError(
            "t_end: missing; this scene has no terminal shape to settle to, give a time to end at "
            "(--t-end; in a scene file, t_end under numerics)"
        )
    system = system_of(scene)
    integrator = numerics.integrator_for(system, scene)
    monitor = SettlingMonitor(scene, system, numerics.t_end is not None, numerics.max_time)
    path = integrator.states(system.to_state(scene.start()), numerics.interval)
    states = _collect(path, monitor, numerics, progress)
    run = Run.of(system, numerics.interval * np.arange(len(states)), states)
    settled_to = monitor.settled_to(run.states[-1], run.shapes[-1])
    run, settled, distance = _cut(run, monitor.terminal, settled_to, scene, numerics)
    checks = check(scene, system, run, distance)
    checks.require(own_effects=bool(scene.own))
    estimated = estimate_error(scene, numerics, system, run) if needs_estimate(scene, numerics) else None
    metadata = _metadata(scene, numerics, integrator) | {
        "checks": checks.to_dict(),
        "error_estimate": estimated,
        "settled_to": settled_to,
        "settling_time": settled,
        "audit": [verdict.to_dict() for verdict in audit(scene, run)],
    }
    return Trajectory(run.t, run.positions, metadata)


def system_of(scene: Scene) -> System | MirrorSymmetric:
    """The equations of motion; of one half where the scene asks for exact symmetry."""
    system = assemble(scene)
    return MirrorSymmetric(system) if scene.is_mirror_symmetric else system


def _collect(path: Iterator[State], monitor: SettlingMonitor, numerics: Numerics, progress: Watcher | None) -> State:
    """Collect states (T, beads d + 1) until the end, or until the run has settled beyond doubt."""
    t_end = numerics.t_end
    last = np.inf if t_end is None else np.floor(t_end / numerics.interval * (1 + 1e-12))
    collected: list[State] = []
    for k, y in enumerate(path):
        collected.append(y)
        if progress:
            progress(k * numerics.interval, t_end)
        if k >= last or (t_end is None and k % _LOOK_EVERY == 0 and monitor.is_over(k * numerics.interval, y)):
            break
    return np.array(collected)


def _cut(
    run: Run, terminal: Positions | None, settled_to: str | None, scene: Scene, numerics: Numerics
) -> tuple[Run, float | None, float | None]:
    """The run up to the first sample after the settling time to the terminal U, that time, and the last distance."""
    if terminal is None:
        return run, None, None
    distance = distance_to_terminal(run.shapes, terminal, scene.length)
    settled = settling_time(run.t, distance) if settled_to == "U" else None
    keep = len(run.t) if settled is None or numerics.t_end is not None else int(np.searchsorted(run.t, settled)) + 1
    return run.until(keep), settled, float(distance[keep - 1])


def _metadata(scene: Scene, numerics: Numerics, integrator: Integrator) -> dict:
    facts = {
        "kind": "simulation",
        **scene.facts(),
        "numerics": asdict(numerics),
        "counters": asdict(integrator.counters),
    }
    own = {part.file: hashlib.sha256(Path(part.file).read_bytes()).hexdigest() for part in scene.own}
    return facts | {"own_sha256": own} if own else facts
