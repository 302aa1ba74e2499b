"""SciPy's implicit solver classes, stepped one by one with the analytic Jacobian."""

from collections.abc import Iterator

import numpy as np
from scipy import integrate

from sedfiber.core.array_types import Matrix, State
from sedfiber.physics.integrators.base import FIRST_STEP, LONGEST_FIRST, MOST_STEPS, Integrator


class _SciPyIntegrator(Integrator):
    """Step a SciPy ``OdeSolver`` and read the samples off its dense output."""

    solver_class: type[integrate.OdeSolver]

    def states(self, start: State, interval: float) -> Iterator[State]:
        solver = self.solver_class(
            self.system.rhs,
            0.0,
            start,
            np.inf,
            first_step=min(FIRST_STEP * interval, LONGEST_FIRST),
            rtol=self.tolerances.rtol,
            atol=self.tolerances.atol,
            jac=self._jacobian,
        )
        yield start
        sample, steps_before = 1, 0
        while True:
            self._step(solver)
            if self.counters.steps - steps_before > MOST_STEPS:
                raise self.stuck(solver.t, solver.y, "too many steps in one sample", "try another --integrator")
            if sample * interval > solver.t:
                continue
            path = solver.dense_output()
            while sample * interval <= solver.t:
                yield self.require_finite(solver.t, path(sample * interval))
                sample, steps_before = sample + 1, self.counters.steps

    def _jacobian(self, t: float, y: State) -> Matrix:
        """Finite, or an error here: SciPy's factorisation would end in one without a time."""
        assert self.system.jacobian is not None
        jac = self.system.jacobian(t, y)
        if not np.isfinite(jac).all():
            raise self.stuck(t, y, "the Jacobian is not finite", "try a smaller --rtol")
        return jac

    def _step(self, solver: integrate.OdeSolver) -> None:
        before = solver.t
        solver.step()
        self.counters.steps += 1
        self.counters.rhs = self.system.rhs_count
        self.counters.jacobians = self.system.jacobian_count
        self.counters.factorisations = int(solver.nlu)
        self.require_finite(solver.t, solver.y)
        if solver.status != "running" or solver.t <= before:
            raise self.stuck(solver.t, solver.y, "the step size fell to zero", "try another --rtol or --integrator")


class BDF(_SciPyIntegrator):
    """Variable-order backward differentiation, orders 1–5 (Shampine & Reichelt 1997)."""

    name, solver_class = "BDF", integrate.BDF


class Radau(_SciPyIntegrator):
    """Implicit Runge–Kutta Radau IIA of order 5 (Hairer & Wanner 1996)."""

    name, solver_class = "Radau", integrate.Radau
