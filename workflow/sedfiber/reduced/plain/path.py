"""One start's path in latent space: the steps of `compiled.latent_path`, in NumPy.

The state is [h (d), c − c(0) − U_term t (2)] in latent units and L/2. A path is a mesh of times and,
for each step between them, the coefficients (5, n) of the state in powers of θ = (t − t_k)/(t_k+1 − t_k).
"""

from collections.abc import Callable

import numpy as np

from sedfiber.core.array_types import Array, Times
from sedfiber.reduced.compiled.tableau import DEGREE, ERROR, EXTENSION, ORDER, STAGES, A
from sedfiber.reduced.compiled.tolerances import LEAST_ASYMMETRY

Rates = Callable[[Array], Array]
_ROWS = [A[i, :i].copy() for i in range(STAGES)]


class NotFinite(ArithmeticError):
    """A state left the numbers."""


class Stuck(ArithmeticError):
    """The time, which is the argument, no longer advances."""


class LatentPath:
    """The path from ``start`` (n,) at time 0, made as far as the latest time asked; ``atol`` (n,).

    It goes beyond the last of them by a part of a step, so that a state does not depend on what
    else was asked.
    """

    def __init__(self, rates: Rates, start: Array, rtol: float, atol: Array) -> None:
        self._rates, self._rtol, self._atol = rates, rtol, atol
        self._y, self._k = start, np.empty((STAGES, start.size))
        self._k[0] = rates(start)
        self._step, self._before = _first_step(rates, start, self._k[0], rtol, atol), 1.0
        self._mesh = [0.0]
        self._coefficients: list[Array] = []

    def __call__(self, t: Times) -> Array:
        """States (T, n) at ascending times (T,). Raises NotFinite or Stuck."""
        with np.errstate(all="ignore"):  # numbers that are not finite end in an error of their own
            while not self._coefficients or self._mesh[-1] < t[-1]:
                self._advance()
        mesh = np.array(self._mesh)
        step = np.searchsorted(mesh[1:-1], t)
        theta = ((t - mesh[step]) / (mesh[step + 1] - mesh[step]))[:, None]
        c = np.array(self._coefficients)[step]
        states = c[:, DEGREE]
        for power in range(DEGREE - 1, -1, -1):
            states = states * theta + c[:, power]
        return states

    def _advance(self) -> None:
        """Try a step: add it to the path if its error is allowed, and choose the next."""
        y, k, t, step = self._y, self._k, self._mesh[-1], self._step
        end = _stages(self._rates, y, k, step)
        ratio = _error_ratio(y, end, k, step, self._rtol, self._atol)
        self._step = _next_step(step, ratio, self._before)
        if ratio <= 1.0:
            self._coefficients.append(np.vstack([y, step * (EXTENSION @ k)]))
            self._mesh.append(t + step)
            self._y, k[0], self._before = end, k[-1], ratio
        elif t + 1e-3 * step == t:
            raise Stuck(t)


def tolerances(start: Array, d: int, atol: float) -> Array:
    """Absolute tolerances (n,), tighter for the odd latent variables of a nearly symmetric start."""
    n_odd = (d + 1) // 2
    bounds = np.full(start.size, atol)
    bounds[:n_odd] *= min(1.0, max(np.abs(start[:n_odd]).max(initial=0.0), LEAST_ASYMMETRY))
    return bounds


def _stages(rates: Rates, y: Array, k: Array, step: float) -> Array:
    """Fill the stages ``k`` (7, n) after the first; the step's end."""
    end = y
    for i in range(1, STAGES):
        end = y + step * (_ROWS[i] @ k[:i])
        k[i] = rates(end)
    return end


def _error_ratio(y: Array, end: Array, k: Array, step: float, rtol: float, atol: Array) -> float:
    """Root mean square over the components of the step's error over its tolerance; 1 is just allowed."""
    error = step * (ERROR @ k) / (atol + rtol * np.maximum(np.abs(y), np.abs(end)))
    ratio = float(np.sqrt(error @ error / error.size))
    if not np.isfinite(ratio):
        raise NotFinite
    return ratio


def _next_step(step: float, ratio: float, before: float) -> float:
    """As `compiled.runge_kutta.next_step`."""
    ratio = max(ratio, 1e-8)
    if ratio > 1.0:
        return step * max(0.2, 0.9 * ratio ** (-1.0 / ORDER))
    return step * min(5.0, max(0.2, 0.9 * ratio ** (-0.7 / ORDER) * max(before, 1e-4) ** (0.4 / ORDER)))


def _first_step(rates: Rates, y: Array, rate: Array, rtol: float, atol: Array) -> float:
    """As `compiled.runge_kutta.first_step`, after a trial step that moves no component by more than 0.01."""
    trial = 0.01 / max(1e-6, np.abs(rate).max())
    scale = atol + rtol * np.abs(y)
    speed, change = (float(np.linalg.norm(x / scale)) for x in (rate, (rates(y + trial * rate) - rate) / trial))
    largest = max(speed, change) / np.sqrt(y.size)
    return float(min(100.0 * trial, (0.01 / max(largest, 1e-15)) ** (1.0 / ORDER)))
