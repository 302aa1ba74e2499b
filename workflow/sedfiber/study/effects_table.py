"""Every effect added to, or taken from, one scene of the study: what it costs and what it changes."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from sedfiber.core.errors import InputError, SedfiberError
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.costs.timing import timed, timed_together

# What is changed of the study's scene, in its own keys; walls and second fibers keep their distance.
_VOLUME = {"space": "volume"}
CHANGES: dict[str, dict[str, Any]] = {
    "the study's scene": {},
    "volume": _VOLUME,
    "volume, 1e-4 a out of plane": _VOLUME | {"disturbance": {"amplitude": 1e-4}},
    "no hydrodynamics": {"hydrodynamics": "none"},
    "Oseen": {"hydrodynamics": "Oseen"},
    "RPY with overlap form": {"hydrodynamics": "RPY-overlap"},
    "gravity 1 % stronger": {"gravity": {"strength": 1.01}},
    "gravity turned by 0.01 rad": {"gravity": {"direction": [float(np.sin(0.01)), -float(np.cos(0.01))]}},
    "no gravity": {"gravity": None},
    "stretching 10 times stiffer": {"stretching": {"factor": 10.0}},
    "no bending": {"bending": None},
    "intrinsic curvature 1e-3/a": {"bending": {"curvature": 1e-3}},
    "vertical wall 60 a beside": _VOLUME | {"wall": {"point": [-60, 0, 0], "normal": [1, 0, 0]}},
    "shear 1e-3": {"flow": {"name": "shear", "rate": 1e-3}},
    "shear 1e-3 without couple": {"flow": {"name": "shear", "rate": 1e-3, "couple": False}},
    "extension 1e-3": {"flow": {"name": "extension", "rate": 1e-3}},
    "rotation 1e-3": {"flow": {"name": "rotation", "rate": 1e-3}},
    "parabolic flow, 1 U_s over 1000 a": {"flow": {"name": "parabolic", "peak": 1.0, "half_width": 1000.0}},
    "contact": {"contact": {}},
    "thermal noise, Pe = 1000": {"hydrodynamics": "RPY-overlap", "noise": {"peclet": 1000.0, "step": 0.05}},
    "second fiber 100 a beside": {"fibers": [{}, {"place": [100, 0]}]},
}


def effect_rows(scene: Scene) -> Iterator[dict[str, Any]]:
    """A row for each change: cost of right-hand side, Jacobian and run, and change of the shape and speed at the end.

    All runs end where the study's scene has settled.  The shape is compared bead by bead relative
    to the centre bead, root-mean-square over L; the speed is the centre bead's, over the last
    interval.  A change that the scene refuses, or that does not run, has its reason for a status.
    """
    base = simulate(scene)
    t_end = float(base.t[-1])
    for name, change in CHANGES.items():
        row: dict[str, Any] = {"effect": name, "status": "runs", "reason": ""}
        try:
            changed = Scene.from_dict(scene.to_dict() | change)
            run = simulate(changed, t_end=t_end)
        except SedfiberError as error:
            status = "refused" if isinstance(error, InputError) else "fails"
            yield row | {"status": status, "reason": str(error)}
            continue
        yield row | _costs(changed, t_end) | _counts(run) | _influence(run, base, scene)


def _costs(scene: Scene, t_end: float) -> dict[str, float]:
    """Microseconds of one right-hand side and one Jacobian at the start, seconds of the whole integration."""
    system = assemble(scene)
    y = system.to_state(scene.start())
    rhs, jacobian = timed_together([lambda: system.rhs(0.0, y), lambda: system.jacobian(0.0, y)])
    run = timed(lambda: _integrate(scene, t_end))
    return {
        "rhs_us": 1e6 * rhs.least,
        "rhs_median_us": 1e6 * rhs.median,
        "jacobian_us": 1e6 * jacobian.least,
        "jacobian_median_us": 1e6 * jacobian.median,
        "run_s": run.least,
        "run_median_s": run.median,
        "run_spread_s": run.spread,
    }


def _integrate(scene: Scene, t_end: float) -> None:
    """The integration alone, without checks and audit."""
    numerics = Numerics().for_scene(scene)
    system = assemble(scene)
    states = numerics.integrator_for(system, scene).states(system.to_state(scene.start()), numerics.interval)
    for k, _ in enumerate(states):
        if k * numerics.interval >= t_end:
            return


def _counts(run: Trajectory) -> dict[str, int]:
    counters = run.metadata["counters"]
    return {key: counters[key] for key in ("steps", "rhs", "jacobians", "factorisations")}


def _influence(run: Trajectory, base: Trajectory, scene: Scene) -> dict[str, float]:
    """Change of the last shape in L, of the speed in %, and of the place in L; the first fiber's of several."""
    shapes = [one.shape[-1, : scene.n_beads] for one in (base, run)]
    speeds = [np.linalg.norm(one.centre[-1] - one.centre[-2]) for one in (base, run)]
    apart = np.linalg.norm(run.centre[-1] - base.centre[-1])
    return {
        "shape_change_L": float(np.sqrt(((shapes[1] - shapes[0]) ** 2).sum(axis=1).mean()) / scene.length),
        "speed_change_percent": float(100.0 * (speeds[1] / speeds[0] - 1.0)),
        "place_change_L": float(apart / scene.length),
    }
