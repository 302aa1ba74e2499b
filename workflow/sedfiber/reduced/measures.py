"""Error measures of forecasts and reconstructions.

    E_shape(t) = Σ_beads |ΔX̄|² / (N L²)
    E_pos(t)   = |Δc|² / |c(t) − c(0)|²           from the first sample after t = 0
    E(t)       = E_shape + E_pos

Norms are squared: E = 1e-4 is 1 % of the length. The reconstruction loss is ‖X̌ − D(E(X̌))‖²
in units of L/2, summed over coordinates.
"""

from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import Array, History
from sedfiber.core.errors import InputError


@dataclass(frozen=True)
class ForecastError:
    """E_shape and E_pos of one forecast at every sample after t = 0, shape (T − 1,) each."""

    shape: Array
    position: Array

    @property
    def total(self) -> Array:
        """E(t) at every sample after t = 0, shape (T − 1,)."""
        return self.shape + self.position


def forecast_error(truth: History, forecast: History) -> ForecastError:
    """E(t) of ``forecast`` against ``truth``, both (T, N, 3), lengths in ``a``.

    Raises InputError when the two differ in shape.
    """
    if truth.shape != forecast.shape:
        raise InputError(f"forecast has shape {forecast.shape}, the trajectory {truth.shape}")
    n_beads = truth.shape[1]
    length = 2.0 * n_beads
    middle = n_beads // 2
    centre, guess = truth[:, middle], forecast[:, middle]
    offset = (truth - centre[:, None]) - (forecast - guess[:, None])
    shape = (offset**2).sum(axis=(1, 2)) / (n_beads * length**2)
    travelled = ((centre - centre[0]) ** 2).sum(axis=1)
    position = ((centre - guess) ** 2).sum(axis=1)[1:] / travelled[1:]
    return ForecastError(shape[1:], position)


def ensemble_mean(errors: list[Array]) -> Array:
    """Mean of E(t) over trajectories of different lengths (T_i,), each until its own end."""
    longest = max(len(error) for error in errors)
    padded = np.full((len(errors), longest), np.nan)
    for row, error in zip(padded, errors, strict=True):
        row[: len(error)] = error
    return np.nanmean(padded, axis=0)


def reconstruction_errors(residual: Array, reconstructed: Array) -> Array:
    """‖X̌ − D(E(X̌))‖² of each sample: two (T, 3N) give (T,)."""
    return ((residual - reconstructed) ** 2).sum(axis=-1)
