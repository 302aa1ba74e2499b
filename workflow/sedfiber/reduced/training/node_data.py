"""The training data of the neural ODE: encoded samples of all training trajectories."""

from dataclasses import dataclass

import numpy as np
import torch
from scipy.interpolate import CubicSpline
from torch import Tensor

from sedfiber.core.array_types import Array
from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import Dataset, SettlingFall
from sedfiber.reduced.neural_ode import N_CENTRE
from sedfiber.reduced.scaling import residual_history
from sedfiber.reduced.training.sampling import path_coordinate, path_even_indices


@dataclass(frozen=True)
class EncodedSamples:
    """P samples of S trajectories, one trajectory after the other; units a/U_s and L/2.

    Float32 tensors ``t`` (P,), ``h`` (P, d), modal coefficients ``z`` (P, r), ``drift``
    c − c(0) − U_term t (P, 2), ``rates`` of h and drift (P, d+2), ``travelled``
    |c − c(0)|² (P,), ``path`` to the next sample (P,). ``context`` (S, 1+d) is [b, h_term];
    ``first``, ``last`` (S,) and the path-even ``even`` (S, n) are row numbers.
    """

    t: Tensor
    h: Tensor
    z: Tensor
    drift: Tensor
    rates: Tensor
    travelled: Tensor
    path: Tensor
    context: Tensor
    first: Tensor
    last: Tensor
    even: Tensor

    def path_even(self) -> tuple[Tensor, Tensor, Tensor]:
        """Path-even samples as rows: h (S n, d), rates (S n, d+2), context (S n, 1+d)."""
        rows = self.even.flatten()
        return self.h[rows], self.rates[rows], self.context.repeat_interleave(self.even.shape[1], dim=0)


def encode_samples(training: Dataset, encoder: Autoencoder, count: int) -> EncodedSamples:
    """Encode with a float64 autoencoder; ``count`` path-even samples of each trajectory."""
    scales = encoder.scales
    columns = [_columns(trajectory, encoder) for trajectory in training]
    lengths = np.array([len(trajectory.t) for trajectory in training])
    first = np.cumsum(lengths) - lengths
    even = np.array([path_even_indices(trajectory, scales, count) for trajectory in training])
    rows = {
        name: torch.tensor(np.concatenate([column[name] for column in columns]), dtype=torch.float32)
        for name in columns[0]
    }
    return EncodedSamples(
        **rows,
        context=torch.cat([encoder.context_of(one.B, one.terminal) for one in training]).float(),
        first=torch.tensor(first),
        last=torch.tensor(first + lengths - 1),
        even=torch.tensor(first[:, None] + even),
    )


def _columns(trajectory: SettlingFall, encoder: Autoencoder) -> dict[str, Array]:
    scales = encoder.scales
    residual = torch.tensor(residual_history(trajectory, scales))
    context = encoder.context_of(trajectory.B, trajectory.terminal).expand(len(residual), -1)
    with torch.no_grad():
        z = encoder.modal(residual)
        h = encoder.encode_modal(z, context)
    centre = scales.centre(trajectory.positions)[:, :N_CENTRE]
    steady = trajectory.terminal_velocity[:N_CENTRE] / scales.half_length
    drift = centre - centre[0] - trajectory.t[:, None] * steady
    travelled = ((centre - centre[0]) ** 2).sum(axis=1)
    travelled[0] = travelled[1]  # E_pos is not defined at the start; never divide by zero
    path = path_coordinate(trajectory, scales)
    return {
        "t": trajectory.t,
        "h": h.numpy(),
        "z": z.numpy(),
        "drift": drift,
        "rates": CubicSpline(trajectory.t, np.concatenate([h.numpy(), drift], axis=1))(trajectory.t, 1),
        "travelled": travelled,
        "path": np.diff(path, append=path[-1]),
    }
