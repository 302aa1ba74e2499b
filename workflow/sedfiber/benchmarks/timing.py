"""One way of timing: in this process, warmed up, at least ten repeats, one thread."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

REPEATS = 10
_LEAST = 2e-3  # s: calls are bundled until a repeat lasts this long, far above the clock's grain


@dataclass(frozen=True)
class Timing:
    """Seconds of one call: least, median and (third minus first quartile) of the repeats."""

    least: float
    median: float
    spread: float


def timed(call: Callable[[], object], repeats: int = REPEATS) -> Timing:
    """Time ``call``; what it costs to bundle calls in a loop, about 30 ns each, is in the figure."""
    return timed_together([call], repeats)[0]


def timed_together(calls: list[Callable[[], object]], repeats: int = REPEATS) -> list[Timing]:
    """Time several calls turn and turn about, so that a busy machine slows all of them alike."""
    bundles = [_bundle(call) for call in calls]
    seconds = np.array([[_seconds(call, n) for call, n in zip(calls, bundles, strict=True)] for _ in range(repeats)])
    quartiles = np.percentile(seconds, [25, 75], axis=0)
    spreads = quartiles[1] - quartiles[0]
    columns = (seconds.min(axis=0), np.median(seconds, axis=0), spreads)
    return [Timing(*map(float, values)) for values in zip(*columns, strict=True)]


def _bundle(call: Callable[[], object]) -> int:
    """Calls in one repeat; the first calls warm up."""
    call()
    n = 1
    while _seconds(call, n) * n < _LEAST:
        n *= 2
    return n


def _seconds(call: Callable[[], object], n: int) -> float:
    start = time.perf_counter()
    for _ in range(n):
        call()
    return (time.perf_counter() - start) / n
