"""How far a long job is, on one line of a terminal."""

import sys
import time
from collections.abc import Iterator, Sequence
from typing import TypeVar

Item = TypeVar("Item")
FEW = 50  # items that need no bar
_WIDTH = 30  # letters
_PAUSE = 0.1  # seconds between two pictures of the bar


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
        print(f"\r{'':{_WIDTH + 40}}\r", end="", file=sys.stderr, flush=True)


def _show(done: int, total: int, elapsed: float) -> None:
    full, left = _WIDTH * done // total, elapsed * (total - done) / done
    bar = "#" * full + "." * (_WIDTH - full)
    print(f"\r[{bar}] {done} of {total}, {left:.0f} s left ", end="", file=sys.stderr, flush=True)
