"""One way of timing: in this process, warmed up, one thread, at least ten repeats of all but long runs."""

import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

REPEATS = 10
FEW = 3  # repeats of a run that takes long
LONG, VERY_LONG = 1.0, 5.0  # s: runs from here on are repeated a few times, and not at all
LEAST = 2e-3  # s: calls are bundled until a repeat lasts this long, far above the clock's grain


@dataclass(frozen=True)
class Timing:
    """Seconds of one call: least, median and (third minus first quartile) of the repeats."""

    least: float
    median: float
    spread: float


@dataclass(frozen=True)
class RunTiming(Timing):
    """Timing of a whole run of ``repeats`` repeats, what it returned, and of a short call ``beside`` it, if any."""

    repeats: int
    returned: Any
    beside: Timing | None

    @property
    def units(self) -> float:
        """The run's least time over that of the short call beside it."""
        assert self.beside is not None  # callers have given one
        return self.least / self.beside.least

    @property
    def columns(self) -> dict[str, float]:
        """The same four columns in every table of costs."""
        return seconds_columns(self, self.repeats)


def seconds_columns(timing: Timing, repeats: int) -> dict[str, float]:
    """``seconds_least``, ``seconds_median``, ``seconds_spread`` and ``repeats``."""
    names = ("least", "median", "spread")
    return {f"seconds_{name}": getattr(timing, name) for name in names} | {"repeats": repeats}


def timed(call: Callable[[], object], repeats: int = REPEATS) -> Timing:
    """Time ``call``; what it costs to bundle calls in a loop, about 30 ns each, is in the figure."""
    return timed_together([call], repeats)[0]


def timed_together(calls: list[Callable[[], object]], repeats: int = REPEATS) -> list[Timing]:
    """Time several calls turn and turn about, so that a busy machine slows all of them alike."""
    bundles = [_bundle(call) for call in calls]
    rounds = [[_seconds(call, n) for call, n in zip(calls, bundles, strict=True)] for _ in range(repeats)]
    return [_timing(seconds) for seconds in zip(*rounds, strict=True)]


def timed_run(run: Callable[[], object], beside: Callable[[], object] | None = None) -> RunTiming:
    """Time a whole run; turn and turn about with a short call, where there is one beside it.

    The first run warms up, and ten follow.  One of a second or more needs no warming up: it counts,
    with two more; one of more than 5 s counts alone.
    """
    start = time.perf_counter()
    returned = run()
    first = time.perf_counter() - start
    seconds = [] if first < LONG else [first]
    n = REPEATS if first < LONG else FEW if first <= VERY_LONG else 1
    turns = -(-REPEATS // n)  # no fewer than ten of the short call
    short_call = _repeated(beside, turns) if beside else list
    short = [time for _ in seconds for time in short_call()]
    while len(seconds) < n:
        seconds.append(_seconds(run, 1))
        short += short_call()
    timing = _timing(seconds)
    return RunTiming(**asdict(timing), repeats=n, returned=returned, beside=_timing(short) if beside else None)


def _repeated(call: Callable[[], object], turns: int) -> Callable[[], list[float]]:
    """Seconds of a short call, so many times in turn."""
    bundle = _bundle(call)
    return lambda: [_seconds(call, bundle) for _ in range(turns)]


def _timing(seconds: Sequence[float]) -> Timing:
    first, median, third = np.percentile(seconds, [25, 50, 75])
    return Timing(float(min(seconds)), float(median), float(third - first))


def _bundle(call: Callable[[], object]) -> int:
    """Calls in one repeat; the first calls warm up."""
    call()
    n = 1
    while _seconds(call, n) * n < LEAST:
        n *= 2
    return n


def _seconds(call: Callable[[], object], n: int) -> float:
    start = time.perf_counter()
    for _ in range(n):
        call()
    return (time.perf_counter() - start) / n
