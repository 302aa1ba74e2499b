"""Cost and effect of bead number and hydrodynamics: one fall of the study with few beads and with many."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import lu_factor

from sedfiber.core.array_types import Positions, State
from sedfiber.core.errors import NumericalError, SedfiberError
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.run import simulate
from sedfiber.study.angles import angle_of
from sedfiber.study.costs.fall_problem import FallProblem, Integrated
from sedfiber.study.costs.machine import machine_columns
from sedfiber.study.costs.power_law import fit_power_law
from sedfiber.study.costs.timing import timed_run, timed_together

BEADS = (11, 15, 21, 31, 45, 61, 91, 121, 201, 301)
MOBILITIES = ("RPY", "RPY-overlap", "Oseen", "none")  # RPY first: the others are compared with it
B, ANGLE_INDEX = 1000.0, 12
FIT_FROM = 61  # beads from which costs are near a power of N
_QUANTITIES = {
    "right-hand side": "rhs_s",
    "Jacobian": "jacobian_s",
    "LU factorisation": "lu_s",
    "whole run": "seconds_least",
}
GROWTH_COLUMNS = [
    "hydrodynamics",
    "quantity",
    "exponent",
    "standard_error",
    "prefactor_s",
    "N_from",
    "N_to",
    "machine",
    "rhs_unit_s",
]
_STEP = 0.1  # a/U_s, in the Newton matrix I − h J: what it costs to factorise does not depend on it


@dataclass(frozen=True)
class _Rest:
    """The end of a fall: the terminal shape over L, or the last where there is none, (N, 3); speed in U_s."""

    fall: FallProblem
    shape: Positions
    speed: float
    settling_time: float | None
    last: State


def measure_discretisation(beads: Iterable[int] = BEADS) -> list[dict[str, Any]]:
    """A row for each N and mobility: terminal shape, speed, settling time, and seconds of the fall and its parts.

    A mobility without a terminal shape falls as long as RPY takes to settle, and is compared by its
    last shape.  One that the scene refuses, or that fails, is a row with the reason for a status.
    """
    ends = machine_columns()
    rests: dict[tuple[int, str], _Rest] = {}
    rows = []
    for n in sorted(beads):
        for mobility in MOBILITIES:
            head = {"B": B, "angle_index": ANGLE_INDEX, "n_beads": n, "hydrodynamics": mobility}
            row: dict[str, Any] = head | {"status": "ok"}
            try:
                rest = _rest(n, mobility, rests.get((n, "RPY")))
                rows.append(row | _facts(rest) | _costs(rest))
                rests[n, mobility] = rest
            except SedfiberError as error:
                rows.append(row | {"status": str(error)})
    return [row | _distances(row["n_beads"], row["hydrodynamics"], rests) | ends for row in rows]


def cost_growth(rows: list[dict[str, Any]], start: int = FIT_FROM) -> list[dict[str, Any]]:
    """A row for each mobility and cost: the exponent of N, fitted from ``start`` beads on where there are three N."""
    grown = []
    for mobility in MOBILITIES:
        kept = [r for r in rows if r["hydrodynamics"] == mobility and r["status"] == "ok" and r["n_beads"] >= start]
        if len(kept) < 3:
            continue
        beads = [row["n_beads"] for row in kept]
        for name, column in _QUANTITIES.items():
            law = fit_power_law(beads, [row[column] for row in kept])
            fit = {"exponent": law.exponent, "standard_error": law.standard_error, "prefactor_s": law.prefactor}
            head = {"hydrodynamics": mobility, "quantity": name}
            last = {key: kept[0][key] for key in ("machine", "rhs_unit_s")}
            grown.append(head | fit | {"N_from": beads[0], "N_to": beads[-1]} | last)
    return grown


def _rest(n_beads: int, mobility: str, rpy: _Rest | None) -> _Rest:
    """The end of a fall; raises SedfiberError where there is none."""
    scene = Scene(B, angle_of(ANGLE_INDEX), n_beads, hydrodynamics=mobility)
    if scene.has_terminal_shape:
        run = simulate(scene)
    elif rpy is not None:
        run = simulate(scene, t_end=rpy.fall.times[-1])
    else:
        raise NumericalError(f"{mobility} ends with the settling time of RPY, which does not settle")
    fall = FallProblem(scene, len(run.t))
    last = fall.system.to_state(run.positions[-1, :, : scene.dim])
    if scene.has_terminal_shape:
        terminal = terminal_state(scene)
        return _Rest(fall, terminal.positions / scene.length, terminal.speed, run.settling_time, last)
    speed = np.linalg.norm(fall.system.velocity(run.positions[-1, :, : scene.dim].copy())[n_beads // 2])
    return _Rest(fall, run.shape[-1] / scene.length, float(speed), None, last)


def _facts(rest: _Rest) -> dict[str, Any]:
    return {"speed": rest.speed, "settling_time": rest.settling_time, "t_end": float(rest.fall.times[-1])}


def _costs(rest: _Rest) -> dict[str, Any]:
    """Seconds of the whole integration, and of one right-hand side, Jacobian and factorisation at its end."""
    fall, system, y = rest.fall, rest.fall.system, rest.last
    whole = timed_run(lambda: fall.by_numerics(Numerics()), fall.rhs)
    run: Integrated = whole.returned
    newton = np.eye(y.size) - _STEP * system.jacobian(0.0, y)
    calls = (lambda: system.rhs(0.0, y), lambda: system.jacobian(0.0, y), lambda: lu_factor(newton))
    parts = dict(zip(("rhs_s", "jacobian_s", "lu_s"), (part.least for part in timed_together([*calls])), strict=True))
    return whole.columns | run.columns | {"rhs_units": whole.units} | parts


def _distances(n_beads: int, mobility: str, rests: dict[tuple[int, str], _Rest]) -> dict[str, float]:
    """Distances from the finest N of the same mobility, and from RPY at the same N; NaN where there is none."""
    own, rpy = rests.get((n_beads, mobility)), rests.get((n_beads, "RPY"))
    finest = max((rest for (_, name), rest in rests.items() if name == mobility), key=_beads, default=None)
    return {
        "shape_from_finest_L": curve_distance(own.shape, finest.shape) if own and finest else float("nan"),
        "shape_from_RPY_L": curve_distance(own.shape, rpy.shape) if own and rpy else float("nan"),
    }


def _beads(rest: _Rest) -> int:
    return len(rest.shape)


def curve_distance(shape: Positions, finer: Positions) -> float:
    """Largest distance of a bead from its place on the curve through the beads of a finer shape.

    Both (N, 3), over their own L and relative to the centre bead; bead i of N is at arclength
    ``(i − (N − 1)/2)/N`` of L, so the places of few beads lie between those of more.
    """
    curve = CubicSpline(_places(len(finer)), finer)
    return float(np.linalg.norm(shape - curve(_places(len(shape))), axis=1).max())


def _places(n_beads: int) -> np.ndarray:
    return (np.arange(n_beads) - n_beads // 2) / n_beads
