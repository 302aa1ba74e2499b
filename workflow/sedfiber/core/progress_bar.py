"""A progress line in a terminal."""

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

Item = TypeVar("Item")
FEW = 50  # items that need no bar
_WIDTH = 30  # letters
_PAUSE = 0.1  # seconds between two pictures of the bar
_PATIENCE = 2.0  # seconds that a user waits without being told anything


def with_progress(items: Sequence[Item]) -> Iterator[Item]:
    """The items one after the other, with a bar on standard error where it is a terminal and they are many."""
    if len(items) <= FEW or not sys.stderr.isatty():
        yield from items
        return
    begin = shown = time.monotonic()
    try:
        for done, item in enumerate(items):
            if done and time.monotonic() - shown > _PAUSE:
                shown = time.monotonic()
                _show(done, len(items), shown - begin)
            yield item
    finally:
        _wipe()


def _show(done: int, total: int, elapsed: float) -> None:
    full, left = _WIDTH * done // total, elapsed * (total - done) / done
    bar = "#" * full + "." * (_WIDTH - full)
    print(f"\r[{bar}] {done} of {total}, {left:.0f} s left ", end="", file=sys.stderr, flush=True)


@contextmanager
def simulated_time() -> Iterator[Callable[[float, float | None], None] | None]:
    """What shows how far a run has come, for ``simulate(progress=…)``; None where nobody watches a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    shown = time.monotonic() + _PATIENCE

    def show(t: float, t_end: float | None) -> None:
        nonlocal shown
        if time.monotonic() - shown > _PAUSE:
            shown = time.monotonic()
            end = "" if t_end is None else f" of {t_end:g}"
            print(f"\rt = {t:g}{end} a/U_s ", end="", file=sys.stderr, flush=True)

    try:
        yield show
    finally:
        _wipe()


def _wipe() -> None:
    print(f"\r{'':{_WIDTH + 40}}\r", end="", file=sys.stderr, flush=True)
