"""The ways to integrate a fall that are compared: our integrators, SciPy's solvers, and the paper's set-up."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import BDF, DOP853, LSODA, RK45, OdeSolver, Radau, solve_ivp

from sedfiber.core.array_types import State
from sedfiber.core.errors import NumericalError
from sedfiber.physics.integrators import INTEGRATORS, Counters, Tolerances
from sedfiber.physics.integrators.base import FIRST_STEP, LONGEST_FIRST
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.study.costs import source_setup
from sedfiber.study.costs.fall_problem import FallProblem, Integrated, OutOfTime

ANALYTIC, DIFFERENCES, NONE = "analytic", "differences", "none"
SOME, FEW = 2, 4  # every second tolerance for what takes some times as long as the default, every fourth for the rest


@dataclass(frozen=True)
class Method:
    """One way to integrate: ``integrate(fall, tolerance, seconds)``, relative and absolute tolerance alike.

    Raises OutOfTime after so many seconds and NumericalError where it fails.  ``every`` thins the
    ladder of tolerances; a method of ``own_tolerance`` is run with that alone.
    """

    name: str
    jacobian: str
    integrate: Callable[[FallProblem, float, float], Integrated]
    every: int = 1
    own_tolerance: float | None = None

    def ladder(self, tolerances: list[float]) -> list[float]:
        """The tolerances it is run with, the loosest first."""
        if self.own_tolerance is not None:
            return [self.own_tolerance]
        return sorted(tolerances, reverse=True)[:: self.every]


class WithoutJacobian:
    """The equations of a system for a solver that has to difference its Jacobian itself."""

    jacobian = None
    jacobian_count = 0

    def __init__(self, system: System):
        self._system = system
        self.rhs = system.rhs

    @property
    def rhs_count(self) -> int:
        """Evaluations of the right-hand side, those for differences among them."""
        return self._system.rhs_count

    def loss_of_definiteness(self, y: State) -> tuple[str, str] | None:
        """The answer of the whole system."""
        return self._system.loss_of_definiteness(y)


def by_ours(name: str, jacobian: str, fall: FallProblem, tolerance: float, seconds: float) -> Integrated:
    """One of the package's own integrators."""
    system = assemble(fall.scene)
    equations = system if jacobian == ANALYTIC else WithoutJacobian(system)
    return fall.by_integrator(INTEGRATORS[name](equations, Tolerances(tolerance, tolerance)), seconds)


def by_solve_ivp(
    solver: type[OdeSolver], jacobian: str, fall: FallProblem, tolerance: float, seconds: float
) -> Integrated:
    """``scipy.integrate.solve_ivp``; implicit solvers begin with the same short step as ours."""
    system, counters = assemble(fall.scene), Counters()
    options: dict[str, Any] = {}
    if jacobian != NONE:
        options["jac"] = system.jacobian if jacobian == ANALYTIC else None
        options["first_step"] = min(FIRST_STEP * fall.interval, LONGEST_FIRST)
    with np.errstate(over="ignore"):  # of differences by the work, which grow because nothing depends on it
        found = solve_ivp(
            system.rhs,
            (0.0, fall.times[-1]),
            fall.start,
            method=_watched(solver, counters, seconds),
            t_eval=fall.times,
            rtol=tolerance,
            atol=tolerance,
            **options,
        )
    if not found.success:
        raise NumericalError(f"{solver.__name__}: {found.message}")
    counters.rhs, counters.jacobians, counters.factorisations = system.rhs_count, int(found.njev), int(found.nlu)
    return Integrated(system.to_positions(found.y.T), counters)


def by_source_setup(fall: FallProblem, tolerance: float, seconds: float) -> Integrated:
    """The paper's set-up, as far through the fall as the seconds last; its tolerances are its own."""
    run = source_setup.SourceSetup(fall.scene.modulus).run(fall.start_positions, fall.samples, fall.interval, seconds)
    return Integrated(run.positions, Counters(run.steps, run.rhs))


def _watched(solver: type[OdeSolver], counters: Counters, seconds: float) -> type[OdeSolver]:
    """The solver, counting its steps and looking at the clock before each."""
    deadline = time.perf_counter() + seconds

    class Watched(solver):
        def step(self) -> str | None:
            if time.perf_counter() > deadline:
                raise OutOfTime(self.t)
            counters.steps += 1
            return super().step()

    return Watched


def _own(name: str, jacobian: str, every: int = 1) -> Method:
    return Method(name, jacobian, partial(by_ours, name, jacobian), every)


def _solve_ivp(solver: type[OdeSolver], jacobian: str, every: int = 1, name: str = "") -> Method:
    return Method(name or solver.__name__, jacobian, partial(by_solve_ivp, solver, jacobian), every)


METHODS = (
    _own("LSODA", ANALYTIC),
    _own("LSODA", DIFFERENCES, SOME),
    _solve_ivp(LSODA, ANALYTIC, SOME, "LSODA (solve_ivp)"),
    _solve_ivp(LSODA, DIFFERENCES, FEW, "LSODA (solve_ivp)"),
    _own("BDF", ANALYTIC),
    _solve_ivp(BDF, DIFFERENCES, FEW),
    _own("Radau", ANALYTIC, SOME),
    _solve_ivp(Radau, DIFFERENCES, FEW),
    _solve_ivp(DOP853, NONE, FEW),
    _solve_ivp(RK45, NONE, FEW),
    Method("source", NONE, by_source_setup, own_tolerance=source_setup.RTOL),
)
