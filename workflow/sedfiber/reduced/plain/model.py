"""Forecasts by a trained model in plain NumPy: those of `compiled.model`, for one fiber from a cold start.

    h(0) = E(X̌(0); ℬ),   dh/dt = F_h(h; ℬ) − A h,   dc/dt = F_c(h; ℬ)
    X(t) = c(t) + X̄_term(ℬ) + (L/2) D(h(t); ℬ)

To import numba takes longer than a dozen forecasts, and to compile it the first time half a minute.
Here every sample is decoded; nothing is interpolated.
"""

from pathlib import Path

import numpy as np

from sedfiber.core.array_types import Array, History, Times
from sedfiber.reduced.compiled.origin import Origin
from sedfiber.reduced.compiled.tolerances import ATOL, RTOL
from sedfiber.reduced.compiled.trained import TrainedModel, ascending, left_the_numbers, load, stuck
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.plain.network import PlainNetwork
from sedfiber.reduced.plain.path import LatentPath, NotFinite, Rates, Stuck, tolerances

_ROWS = 256  # samples decoded at a time: what the decoder then needs stays in the cache


class PlainModel(TrainedModel):
    """Encoder, decoder and neural ODE; ``rtol`` and ``atol`` (units of h and of L/2) bound the error of a step."""

    _last: tuple[Start, LatentPath] | None = None

    def forecast(self, start: Start, t: Times) -> History:
        """Positions (T, N, 3) at times ``t`` (T,); see `TrainedModel.forecast`."""
        self._require_shapes(start)
        t, origin = ascending(t), self._origin(start)
        try:
            states = self._path(start, origin)(t)
        except NotFinite:
            raise left_the_numbers(start) from None
        except Stuck as error:
            raise stuck(start, *error.args) from None
        return self._positions(origin, t, states)

    def _path(self, start: Start, origin: Origin) -> LatentPath:
        """The last path again, where the start is the same: who looks for its end asks for ever later times."""
        if self._last is None or self._last[0] is not start:
            residual = origin.initial - origin.initial[len(origin.initial) // 2] - origin.terminal
            state = np.append(origin.encoder @ residual.ravel(), [0.0, 0.0])
            bounds = tolerances(state, self.latent_dim, self.atol)
            self._last = start, LatentPath(self._rates(origin), state, self.rtol, bounds)
        return self._last[1]

    def _rates(self, origin: Origin) -> Rates:
        """dy/dt (d + 2,) of the state y (d + 2,)."""
        own, d = self._volume, self.latent_dim
        pace = np.append(np.full(d, origin.pace), [1.0, 1.0])
        network = PlainNetwork(own.rates, own.rates_bias + own.rates_context @ _context(origin), pace)
        damping = pace * np.append(own.damping, [0.0, 0.0])
        return lambda y: network(y[:d]) - damping * y

    def _positions(self, origin: Origin, t: Times, states: Array) -> History:
        """c + X̄_term + (L/2) D(h), (T, N, 3), of states (T, d + 2)."""
        own, d = self._volume, self.latent_dim
        network = PlainNetwork(own.decoder, own.decoder_bias + own.decoder_context @ _context(origin))
        centre = origin.initial[len(origin.initial) // 2] + t[:, None] * origin.velocity
        centre[:, :2] += own.half_length * states[:, d:]
        positions = np.empty((len(t), *origin.terminal.shape))
        for first in range(0, len(t), _ROWS):
            rows, h = positions[first : first + _ROWS], states[first : first + _ROWS, :d]
            np.matmul(network(h) + h @ own.pick, own.modes, out=rows.reshape(len(rows), -1))
            rows += origin.terminal + centre[first : first + _ROWS, None]
        return positions


def load_plain(folder: str | Path, rtol: float = RTOL, atol: float = ATOL) -> PlainModel:
    """The model of a folder such as ``results/models/forecast``; raises InputError for anything else."""
    return load(PlainModel, folder, rtol, atol)


def _context(origin: Origin) -> Array:
    """[b, h_term] (1 + d,)."""
    return np.append(origin.b, origin.encoder @ origin.anchor.ravel())
