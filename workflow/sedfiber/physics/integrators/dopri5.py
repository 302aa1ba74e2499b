"""The paper's integrator: explicit Runge–Kutta 4(5) through ``scipy.integrate.ode``."""

import warnings
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from scipy.integrate import ode

from sedfiber.core.array_types import State
from sedfiber.physics.integrators.base import Integrator

_STEPS_PER_CALL = 1000  # dopri5 tests for stiffness, and gives up, in blocks of this many


class Dopri5(Integrator):
    """``ode('dopri5')``, called once per sample as Fox & Graham 2024 describe.

    Its give-up ("probably stiff") is only visible in ``successful()``; here it is an error.
    """

    name = "dopri5"
    _failure: BaseException | None = None

    def states(self, start: State, interval: float) -> Iterator[State]:
        solver = ode(self._heard(self.system.rhs, np.full_like(start, np.nan)))
        tolerances = {"rtol": self.tolerances.rtol, "atol": self.tolerances.atol}
        solver.set_integrator("dopri5", nsteps=_STEPS_PER_CALL, **tolerances)
        solver.set_solout(self._heard(self._count_step, -1))
        solver.set_initial_value(start, 0.0)
        yield start
        sample = 1
        while True:
            y = self._advance(solver, sample * interval)
            yield y.copy()
            sample += 1

    def _heard(self, callback: Callable, otherwise: Any) -> Callable:
        """``callback``, whose exceptions wait for the end of the call: the solver would go on, and break on them.

        What it is given instead, ``otherwise``, makes it stop.
        """

        def call(t: float, y: State) -> Any:
            if self._failure is None:
                try:
                    return callback(t, y)
                except BaseException as error:  # an effect of the user's that fails, or Ctrl-C
                    self._failure = error
            return otherwise

        return call

    def _count_step(self, t: float, y: State) -> int:
        self.counters.steps += 1
        return 0

    def _advance(self, solver: ode, t: float) -> State:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # its warning becomes our error
            y = solver.integrate(t)
        if self._failure is not None:
            raise self._failure
        self.counters.rhs = self.system.rhs_count
        if not solver.successful():
            why = f"gave up, the problem is probably stiff (return code {solver.get_return_code()})"
            raise self.stuck(solver.t, y, why, "use an implicit --integrator, such as the default")
        return self.require_finite(solver.t, y)
