"""Steps of Tsitouras' Runge–Kutta pair, whose numbers are in `tableau`.

The kernels here know nothing of the networks: a start's state is a row, and its stages are rows
(7, n) of ``k``.
"""

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.core.kernel_cache import kept
from sedfiber.reduced.compiled.tableau import DEGREE, ERROR, EXTENSION, ORDER, STAGES, A


@kept()
def stage(i: int, y: Array, k: Array, step: float, out: Array) -> None:
    """The argument (n,) of stage ``i`` of a step from ``y`` (n,); for the last it is the step's end."""
    for v in range(y.size):
        total = 0.0
        for j in range(i):
            total += A[i, j] * k[j, v]
        out[v] = y[v] + step * total


@kept(error_model="numpy")
def error_ratio(y: Array, end: Array, k: Array, step: float, rtol: float, atol: Array) -> float:
    """Root mean square over the components of the step's error over its tolerance; 1 is just allowed."""
    total = 0.0
    for v in range(y.size):
        error = 0.0
        for j in range(STAGES):
            error += ERROR[j] * k[j, v]
        error *= step / (atol[v] + rtol * max(abs(y[v]), abs(end[v])))
        total += error * error
    return np.sqrt(total / y.size)


@kept()
def continue_step(y: Array, k: Array, step: float, out: Array) -> None:
    """Coefficients (5, n) of y(t + θΔ) in powers of θ."""
    for v in range(y.size):
        out[0, v] = y[v]
        for m in range(DEGREE):
            total = 0.0
            for j in range(STAGES):
                total += EXTENSION[m, j] * k[j, v]
            out[m + 1, v] = step * total


@kept(error_model="numpy")
def next_step(step: float, ratio: float, before: float) -> float:
    """Step after one with this error ratio; ``before`` is the last accepted one's (proportional–integral control).

    Exponents 0.7/5 and 0.4/5 and the bounds are those of Hairer, Nørsett & Wanner (1993), II.4.
    """
    ratio = max(ratio, 1e-8)
    if ratio > 1.0:
        return step * max(0.2, 0.9 * ratio ** (-1.0 / ORDER))
    return step * min(5.0, max(0.2, 0.9 * ratio ** (-0.7 / ORDER) * max(before, 1e-4) ** (0.4 / ORDER)))


@kept(error_model="numpy")
def first_step(y: Array, rate: Array, bend: Array, trial: float, rtol: float, atol: Array) -> float:
    """First step by the rates at the start and ``bend``, those a ``trial`` step later (Hairer et al., II.4)."""
    speed = change = 0.0
    for v in range(y.size):
        scale = atol[v] + rtol * abs(y[v])
        speed += (rate[v] / scale) ** 2
        change += ((bend[v] - rate[v]) / scale) ** 2
    largest = max(np.sqrt(speed / y.size), np.sqrt(change / y.size) / trial)
    return min(100.0 * trial, (0.01 / max(largest, 1e-15)) ** (1.0 / ORDER))
