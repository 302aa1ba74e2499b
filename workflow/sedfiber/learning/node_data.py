"""What the neural ODE is trained on: encoded trajectories on a grid even along their paths."""

from dataclasses import dataclass, fields

import numpy as np
import torch
from scipy.interpolate import CubicSpline
from torch import Tensor

from sedfiber._typing import Array
from sedfiber.learning.autoencoder import Autoencoder
from sedfiber.learning.dataset import Dataset, Trajectory
from sedfiber.learning.neural_ode import N_CENTRE
from sedfiber.learning.sampling import path_even_indices
from sedfiber.learning.scaling import Scales, residual_history

# Samples that are always on the grid, as E_pos divides by the small |c(t) − c(0)|² there.
EARLY = (1, 2, 4)
# Substeps of the first sample interval, where stretching relaxes, as shares of it.
SUBSTEPS = (0.2, 0.5)
N_SUBSTEPS = len(SUBSTEPS)


@dataclass(frozen=True)
class EncodedGrid:
    """S trajectories at K + 1 grid times each; tensors with these shapes, units a/U_s and L/2.

    The points 1 … ``N_SUBSTEPS`` are substeps without data: only their ``t`` counts.
    """

    b: Tensor
    """(S, 1), scaled ln ℬ."""
    t: Tensor
    """(S, K+1), times."""
    h: Tensor
    """(S, K+1, d), latent variables h = E(X̌)."""
    z: Tensor
    """(S, K+1, r), modal coefficients of the shape."""
    drift: Tensor
    """(S, K+1, 2), c − c(0) − U_term t."""
    rates: Tensor
    """(S, K+1, d+2), time derivatives of h and drift."""
    travelled: Tensor
    """(S, K+1), |c − c(0)|²; never zero, at the start it has the value of the first sample."""

    @property
    def n_steps(self) -> int:
        """Number of grid steps K."""
        return self.t.shape[1] - 1

    def samples(self) -> tuple[Tensor, Tensor, Tensor]:
        """All points with data as rows: h (P, d), rates (P, d+2), b (P, 1)."""
        stored = torch.ones(self.n_steps + 1, dtype=torch.bool)
        stored[1 : 1 + N_SUBSTEPS] = False
        h, rates = self.h[:, stored], self.rates[:, stored]
        b = self.b[:, None].expand(-1, h.shape[1], -1)
        return h.flatten(0, 1), rates.flatten(0, 1), b.flatten(0, 1)


def encode_grid(training: Dataset, encoder: Autoencoder, scales: Scales, count: int) -> EncodedGrid:
    """Encode a training set with a float64 autoencoder; ``count`` samples a trajectory."""
    rows = [_encode(trajectory, encoder, scales, count) for trajectory in training]
    columns = {field.name: [row[field.name] for row in rows] for field in fields(EncodedGrid)}
    return EncodedGrid(
        **{name: torch.tensor(np.array(column), dtype=torch.float32) for name, column in columns.items()}
    )


def _encode(trajectory: Trajectory, encoder: Autoencoder, scales: Scales, count: int) -> dict[str, Array]:
    b = scales.log_B([trajectory.B])
    h, z = _latent(trajectory, encoder, scales, b)
    centre = scales.centre(trajectory.positions)[:, :N_CENTRE]
    steady = trajectory.terminal_velocity[:N_CENTRE] / scales.half_length
    drift = centre - centre[0] - trajectory.t[:, None] * steady
    rates = CubicSpline(trajectory.t, np.concatenate([h, drift], axis=1))(trajectory.t, 1)
    travelled = ((centre - centre[0]) ** 2).sum(axis=1)
    travelled[0] = travelled[1]  # stands at the substeps, where no error is taken
    index, t = _grid(trajectory, scales, count)
    columns = {"h": h, "z": z, "drift": drift, "rates": rates, "travelled": travelled}
    return {"b": b, "t": t} | {name: column[index] for name, column in columns.items()}


def _latent(
    trajectory: Trajectory, encoder: Autoencoder, scales: Scales, b: Array
) -> tuple[Array, Array]:
    residual = torch.tensor(residual_history(trajectory, scales))
    with torch.no_grad():
        z = encoder.modal(residual)
        h = encoder.encode_modal(z, torch.tensor(b).expand(len(z), 1))
    return h.numpy(), z.numpy()


def _grid(trajectory: Trajectory, scales: Scales, count: int) -> tuple[Array, Array]:
    """Sample index and time of each grid point; substeps carry the index of the start."""
    even = path_even_indices(trajectory, scales, count)
    samples = np.sort(np.concatenate([even[1:], EARLY])).clip(1, len(trajectory.t) - 1)
    substeps = trajectory.t[1] * np.array(SUBSTEPS)
    index = np.concatenate([np.zeros(1 + N_SUBSTEPS, dtype=int), samples])
    return index, np.concatenate([[0.0], substeps, trajectory.t[samples]])
