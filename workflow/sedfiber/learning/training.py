"""What all trainings share: the learning-rate schedule, the guard and the progress line."""

import math
import time
from collections.abc import Callable

from torch import Tensor

from sedfiber.errors import NumericalError
from sedfiber.learning.optimiser import Soap

Progress = Callable[[str], None]

PROGRESS_INTERVAL = 5.0  # seconds between two lines
WARM_UP = 50  # steps over which the learning rate rises from zero


def silent(line: str) -> None:
    """A progress callback that says nothing."""


def cosine_rate(first: float, step: int, n_steps: int) -> float:
    """Learning rate: a short linear rise, then half a cosine down to ``first``/1000."""
    fall = 0.5 * (1 + math.cos(math.pi * step / n_steps)) + 1e-3
    return first * min(1.0, (step + 1) / WARM_UP) * fall


def descend(optimiser: Soap, loss: Tensor, where: str) -> float:
    """One step down the gradient of ``loss``; returns the loss.

    Raises NumericalError when the loss is not finite.
    """
    value = loss.item()
    require_finite(value, where)
    optimiser.zero_grad()
    loss.backward()
    optimiser.step()
    return value


def require_finite(loss: float, where: str) -> None:
    """Raise NumericalError when ``loss`` is NaN or infinite."""
    if not math.isfinite(loss):
        raise NumericalError(f"the loss became {loss} in {where}; try a smaller learning rate or another seed")


class ProgressLine:
    """Reports step, loss and time left every few seconds; never changes the training."""

    def __init__(self, what: str, n_steps: int, progress: Progress) -> None:
        self.what, self.n_steps, self.progress = what, n_steps, progress
        self.start = self.last = time.monotonic()

    def update(self, step: int, loss: float) -> None:
        """Say something if the last line is old enough, or at the end."""
        now = time.monotonic()
        is_last = step + 1 == self.n_steps
        if now - self.last < PROGRESS_INTERVAL and not is_last:
            return
        self.last = now
        left = (now - self.start) / (step + 1) * (self.n_steps - step - 1)
        self.progress(f"{self.what}: step {step + 1}/{self.n_steps}, loss {loss:.2e}, {left:.0f} s left")
