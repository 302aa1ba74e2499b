"""What the compiled forecasts and those in plain NumPy have in common: neither torch nor numba is imported here."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from sedfiber.core.array_types import Array, History, Times
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.compiled.model_file import read_model
from sedfiber.reduced.compiled.origin import Origin
from sedfiber.reduced.compiled.tables import Encoder, Tables, Tensors, tables
from sedfiber.reduced.compiled.tolerances import ATOL, RTOL
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.model_folder import does_not_fit
from sedfiber.reduced.scaling import Scales

VARIANTS = ("none", "encoder", "decoder", "double")


class TrainedModel(ABC):
    """Encoder, decoder and neural ODE; ``rtol`` and ``atol`` (units of h and of L/2) bound the error of a step.

    Who inherits says how one start is forecast.
    """

    def __init__(self, tensors: Tensors, card: dict[str, Any], rtol: float = RTOL, atol: float = ATOL) -> None:
        facts = card["autoencoder"]
        self.scales = Scales(**facts["scales"])
        self.variant, self.latent_dim = facts["variant"], facts["latent_dim"]
        self.rtol, self.atol = rtol, atol
        self._encoder = Encoder(tensors, self.scales.half_length)
        self._volume = tables(tensors, self.scales.half_length, 3)
        self._require_sizes(self._volume)

    @abstractmethod
    def forecast(self, start: Start, t: Times) -> History:
        """Positions (T, N, 3) of one start at times ``t`` (T,), ascending from ``t[0]`` ≥ 0.

        Raises InputError for shapes or times that do not fit the model, NumericalError when
        the integration fails.
        """

    def forecast_many(self, starts: Sequence[Start], t: Times) -> Array:
        """Positions (S, T, N, 3) of S starts, one by one; raises as `forecast`."""
        return np.array([self.forecast(start, t) for start in starts])

    def start_error(self, start: Start) -> float:
        """How far the model's first shape, D(E(X̌(0))), is from the start: rms bead distance over L."""
        first = self.forecast(start, np.zeros(1))[0]
        shape = self.scales.shape(self.scales.residual(start.initial, start.terminal), start.terminal)
        offset = first - first[self.scales.n_beads // 2] - shape
        return float(np.sqrt((offset**2).sum(axis=1).mean()) / (2.0 * self.scales.half_length))

    def _origin(self, start: Start) -> Origin:
        B, anchor = start.nearest or (start.B, start.terminal)
        b = float(self.scales.log_B(B))
        places = (anchor, start.initial, start.terminal, start.terminal_velocity)
        anchor, initial, terminal, velocity = (np.ascontiguousarray(x, np.float64) for x in places)
        return Origin(self._encoder.at(b), b, anchor, initial, terminal, velocity, start.pace)

    def _require_shapes(self, start: Start) -> None:
        n_beads = self.scales.n_beads
        if start.initial.shape != (n_beads, 3) or start.terminal.shape != (n_beads, 3):
            raise InputError(f"the model was trained on {n_beads} beads, not on {len(start.initial)}")

    def _require_sizes(self, own: Tables) -> None:
        """ValueError for tensors that the card does not describe, before a kernel reads beyond their ends."""
        d, n = self.latent_dim, self.scales.n_beads
        r = len(own.decoder.signs_out)
        found = (own.rates.last.shape[0], own.pick.shape, own.modes.shape, self._encoder.at(0.0).shape)
        if self.variant not in VARIANTS or found != (d + 2, (d, r), (r, 3 * n), (d, 3 * n)):
            raise ValueError(
                f"the card's variant {self.variant!r} and {d} latent variables are not those of the weights"
            )


Model = TypeVar("Model", bound=TrainedModel)


def load(kind: Callable[..., Model], folder: str | Path, rtol: float, atol: float) -> Model:
    """The model of a folder such as ``results/models/forecast``; raises InputError for anything else."""
    tensors, card = read_model(folder)
    try:
        return kind(tensors, card, rtol, atol)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise does_not_fit(folder, error) from error


def ascending(t: Times) -> Array:
    """Times (T,) as the integration takes them; raises InputError for times that do not ascend."""
    t = np.ascontiguousarray(t, dtype=np.float64)
    if len(t) == 0 or t[0] < 0 or not (t[1:] > t[:-1]).all():
        raise InputError("forecast times must ascend from zero or later")
    return t


def left_the_numbers(start: Start) -> NumericalError:
    """What to raise where a state is not finite."""
    return NumericalError(f"the forecast at B={start.B:g} left the numbers; is B far outside the training range?")


def stuck(start: Start, when: float) -> NumericalError:
    """What to raise where the time no longer advances."""
    return NumericalError(f"the forecast at B={start.B:g} is stuck at t={when:g}; loosen rtol and atol")
