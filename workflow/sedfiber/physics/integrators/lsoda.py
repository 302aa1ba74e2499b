"""ODEPACK's switching Adams/BDF method, stepped and interpolated in compiled code."""

import warnings
from collections.abc import Iterator

from scipy.integrate import ode

from sedfiber.core.array_types import State
from sedfiber.physics.integrators.base import FIRST_STEP, LONGEST_FIRST, MOST_STEPS, Integrator

_STEPS, _JACOBIANS = 10, 12  # places of ODEPACK's counters in its integer work array
_OUT_OF_STEPS, _OUT_OF_ACCURACY = -1, -2
_FAILURES = {
    _OUT_OF_STEPS: ("too many steps in one sample", "try another --integrator"),
    _OUT_OF_ACCURACY: ("the tolerances are below round-off", "try a larger --rtol"),
}
_NO_CONVERGENCE = ("Newton's iterations do not converge, however short the step,", "try another --rtol or --integrator")

# They become our errors.  Once and for all: a context for each sample costs as much as a third of the fall.
warnings.filterwarnings("ignore", message="lsoda: ", category=UserWarning)


class LSODA(Integrator):
    """ODEPACK's LSODA (Petzold 1983) with the analytic Jacobian, called once per sample.

    ``scipy.integrate.LSODA`` takes the same steps, but builds an interpolant in Python after each
    of them: measured, that doubles the time of a fall.
    """

    name = "LSODA"

    def states(self, start: State, interval: float) -> Iterator[State]:
        solver = ode(self.system.rhs, self.system.jacobian)
        solver.set_integrator(
            "lsoda",
            with_jacobian=True,
            rtol=self.tolerances.rtol,
            atol=self.tolerances.atol,
            nsteps=MOST_STEPS,
            first_step=min(FIRST_STEP * interval, LONGEST_FIRST),
        )
        solver.set_initial_value(start, 0.0)
        yield start
        sample = 1
        while True:
            y = self._advance(solver, sample * interval)
            yield y.copy()  # the solver goes on in the array that it returns
            sample += 1

    def _advance(self, solver: ode, t: float) -> State:
        y = solver.integrate(t)
        self._count(solver)
        if not solver.successful():
            raise self.stuck(solver.t, y, *_FAILURES.get(solver.get_return_code(), _NO_CONVERGENCE))
        return self.require_finite(solver.t, y)

    def _count(self, solver: ode) -> None:
        work = solver._integrator.iwork  # ode has no public access to what lsoda counts
        self.counters.steps = int(work[_STEPS])
        self.counters.rhs = self.system.rhs_count
        self.counters.jacobians = self.counters.factorisations = int(work[_JACOBIANS])
