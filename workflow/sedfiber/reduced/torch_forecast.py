"""Forecasts of whole trajectories by a trained model.

    h(0) = E(X̌(0); ℬ),   dh/dt = F_h(h; ℬ) − A h,   dc/dt = F_c(h; ℬ)
    X(t) = c(t) + X̄_term(ℬ) + (L/2) D(h(t); ℬ)

integrated by torchdiffeq's dopri5 in float64. The terminal shape and the terminal velocity
come from the steady solve at that ℬ.

Outside the training range F, E and D are those of the nearest trained ℬ, ℬ*, about the terminal
state of the true ℬ; below the range dh/dt is multiplied by ℬ/ℬ*, for a stiff fiber turns at a
rate ∝ ℬ. h = 0 is then as stable as at ℬ*. Measured on the study's model: extrapolated
networks end 0.04 to 0.4 L from the terminal shape at ℬ = 10, 50 and 60000; these do not.
"""

import copy
from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor, nn
from torchdiffeq import odeint

from sedfiber.core.array_types import Array, History, Positions, Times
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.neural_ode import N_CENTRE, NeuralOde
from sedfiber.reduced.scaling import Scales


class ForecastModel:
    """Autoencoder and neural ODE, for inference in float64 at dopri5's tolerances ``rtol`` and ``atol`` (L/2)."""

    def __init__(self, autoencoder: Autoencoder, node: NeuralOde, rtol: float, atol: float) -> None:
        self.autoencoder, self.node, self.rtol, self.atol = autoencoder, node, rtol, atol
        self._encoder = copy.deepcopy(autoencoder).double().requires_grad_(False)
        self._node = copy.deepcopy(node).double().requires_grad_(False)

    @property
    def scales(self) -> Scales:
        """Scales of the training data; `Scales.covers` tells an extrapolation."""
        return self.autoencoder.scales

    def forecast(
        self, B: float, initial: Positions, terminal: Positions, terminal_velocity: Array, t: Times
    ) -> History:
        """Positions (T, N, 3) at times ``t`` (T,); see `forecast_many`."""
        return self.forecast_many([Start(B, initial, terminal, terminal_velocity)], t)[0]

    def forecast_many(self, starts: Sequence[Start], t: Times) -> Array:
        """Positions (S, T, N, 3) at times ``t`` (T,), ascending from ``t[0]`` ≥ 0, of S starts.

        All starts share the step of dopri5, which is as small as the most demanding start
        needs it: a forecast depends on its companions within the tolerances, and is never
        less accurate than alone. The initial positions are those at time 0.

        Raises InputError for shapes or times that do not fit the model, NumericalError
        when the integration fails.
        """
        self._check(starts, t)
        context = self._context(starts)
        h, drift = self._integrate(self._latent(starts, context), context, self._pace(starts), t)
        residual = self._encoder.decode(h.flatten(0, 1), context.expand(len(t), -1, -1).flatten(0, 1))
        residuals = residual.unflatten(0, h.shape[:2]).transpose(0, 1).numpy()
        drifts = nn.functional.pad(drift, (0, 3 - N_CENTRE)).transpose(0, 1).numpy()
        return np.stack([self._assemble(*parts, t) for parts in zip(starts, residuals, drifts, strict=True)])

    def start_error(self, start: Start) -> float:
        """How far the model's first shape, D(E(X̌(0))), is from the start: rms bead distance over L."""
        self._check([start], np.zeros(1))
        shape = self.scales.shape(self.scales.residual(start.initial, start.terminal), start.terminal)
        first = self.forecast_many([start], np.zeros(1))[0, 0]
        offset = first - first[self.scales.n_beads // 2] - shape
        return float(np.sqrt((offset**2).sum(axis=1).mean()) / (2.0 * self.scales.half_length))

    def _context(self, starts: Sequence[Start]) -> Tensor:
        return torch.cat([self._encoder.context_of(*(one.nearest or (one.B, one.terminal))) for one in starts])

    def _latent(self, starts: Sequence[Start], context: Tensor) -> Tensor:
        residual = np.stack([self.scales.residual(start.initial, start.terminal) for start in starts])
        return self._encoder.encode(torch.tensor(residual, dtype=torch.float64), context)

    def _pace(self, starts: Sequence[Start]) -> Tensor:
        """Factors on the rates of h and of the drift, (S, d + 2)."""
        pace = torch.tensor([[start.pace] for start in starts], dtype=torch.float64)
        return nn.functional.pad(pace.expand(-1, self._node.latent_dim), (0, N_CENTRE), value=1.0)

    def _integrate(self, h: Tensor, context: Tensor, pace: Tensor, t: Times) -> tuple[Tensor, Tensor]:
        """h (T, S, d) and the drift c − c(0) − U_term t, (T, S, 2)."""
        d, rest = h.shape[1], self._node.rest(context)
        state = nn.functional.pad(h, (0, N_CENTRE))
        skipped = 0 if t[0] == 0 else 1
        times = torch.tensor(np.concatenate([np.zeros(skipped), t]))
        if len(times) == 1:
            return state[None, :, :d], state[None, :, d:]
        try:
            states = odeint(
                lambda _, y: pace * self._node(y[:, :d], context, rest),
                state,
                times,
                rtol=self.rtol,
                atol=self.atol,
                method="dopri5",
                options={"norm": _worst_of_starts},
            )[skipped:]
        except AssertionError as error:
            raise NumericalError(f"the forecast's integration failed: {error}") from error
        if not torch.isfinite(states).all():
            raise NumericalError("the forecast left the numbers; is B far outside the training range?")
        return states[..., :d], states[..., d:]

    def _assemble(self, start: Start, residual: Array, drift: Array, t: Times) -> History:
        scales = self.scales
        origin = start.initial[scales.n_beads // 2]
        centre = origin + scales.half_length * drift + t[:, None] * start.terminal_velocity
        return centre[:, None] + scales.shape(residual, start.terminal)

    def _check(self, starts: Sequence[Start], t: Times) -> None:
        n_beads = self.scales.n_beads
        for start in starts:
            if start.initial.shape != (n_beads, 3) or start.terminal.shape != (n_beads, 3):
                raise InputError(f"the model was trained on {n_beads} beads, not on {len(start.initial)}")
        if len(t) == 0 or t[0] < 0 or not (np.diff(t) > 0).all():
            raise InputError("forecast times must ascend from zero or later")


def _worst_of_starts(state: Tensor) -> Tensor:
    """The largest root mean square of a start's row: a mean over rows would let calm ones hide a wild one."""
    return state.square().mean(dim=1).sqrt().max()
