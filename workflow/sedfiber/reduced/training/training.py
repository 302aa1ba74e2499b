"""The optimiser, learning-rate schedule, guard and progress line of all trainings."""

import math
import time
from collections.abc import Callable, Iterable, Sequence

import torch
from pytorch_optimizer import SOAP
from torch import Tensor
from torch.optim import Optimizer

from sedfiber.core.errors import NumericalError

Progress = Callable[[str], None]

PROGRESS_INTERVAL = 15.0  # seconds between two lines
WARM_UP = 50  # steps over which the learning rate rises from zero
MOST_SKIPPED = 5  # bad steps of one training stage that are recovered from
JUMP = 1e3  # times a stage's first loss is divergence: tanh saturates, so that a loss may explode and stay finite.
# Measured: no sound training went above 3 times its first loss.


def silent(line: str) -> None:
    """A progress callback that says nothing."""


def cosine_rate(first: float, step: int, n_steps: int) -> float:
    """Learning rate: a short linear rise, then half a cosine down to ``first``/1000."""
    fall = 0.5 * (1 + math.cos(math.pi * step / n_steps)) + 1e-3
    return first * min(1.0, (step + 1) / WARM_UP) * fall


def soap(parameters: Iterable[Tensor]) -> Optimizer:
    """SOAP: Adam in the eigenbasis of Shampoo's preconditioner (Vyas et al. 2024, arXiv:2409.11321).

    On these small regressions it reaches a 10 to 30 times smaller loss than Adam in the same
    time. The learning rate is set before each step (`Descent`).
    """
    return SOAP(list(parameters), betas=(0.95, 0.95), weight_decay=0.0, precondition_frequency=10, eps=1e-12)


class Descent:
    """Steps down the gradient of one training stage, with a guard.

    A step whose loss or whose gradient's square is not finite, or whose loss is above JUMP times
    the first, is skipped: the optimiser never sees it, the parameters go back to the last ones
    that were good, and the learning rate is halved from then on. ``names`` holds what messages
    call each trajectory.
    """

    def __init__(self, optimiser: Optimizer, names: Sequence[str], where: str, progress: Progress) -> None:
        self.optimiser, self.names, self.where, self.progress = optimiser, names, where, progress
        self.group = optimiser.param_groups[0]
        self.skipped, self.good, self.most = 0, self._copies(), math.inf

    def step(self, rate: float, loss: Tensor, errors: Tensor, which: Tensor) -> float:
        """One step with learning rate ``rate``; returns the loss.

        ``errors`` (S,) are what the loss is made of, ``which`` (S,) the number of each one's
        trajectory. Raises NumericalError, which names a trajectory, for one bad step too many.
        """
        value = loss.item()
        self.group["lr"] = rate * 0.5**self.skipped
        if not math.isfinite(value) or value > self.most:
            self._skip(f"the loss became {value:.3g}", errors, which)
        elif not math.isfinite(size := self._gradient_square(loss)):
            self._skip(f"the gradient's square became {size:.3g}", errors, which)
        else:
            self.good = self._copies()
            self.most = JUMP * value if math.isinf(self.most) else self.most
            self.optimiser.step()
        return value

    def _copies(self) -> list[Tensor]:
        return [parameter.detach().clone() for parameter in self.group["params"]]

    def _gradient_square(self, loss: Tensor) -> float:
        """Σ g², which SOAP's averages hold: it overflows before the gradient does."""
        self.optimiser.zero_grad()
        loss.backward()
        return torch.stack([parameter.grad.square().sum() for parameter in self.group["params"]]).sum().item()

    def _skip(self, what: str, errors: Tensor, which: Tensor) -> None:
        self.skipped += 1
        worst = int(which[errors.detach().nan_to_num(nan=torch.inf).argmax()])
        what = f"{self.where}: {what} in the trajectory with {self.names[worst]}"
        if self.skipped > MOST_SKIPPED:
            raise NumericalError(
                f"{what}, {self.skipped} bad steps in all; try a smaller learning rate, another seed, "
                "or leave this trajectory out"
            )
        for parameter, good in zip(self.group["params"], self.good, strict=True):
            parameter.data.copy_(good)
        self.progress(f"{what}; step skipped, learning rate halved")


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
