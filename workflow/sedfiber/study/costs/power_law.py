"""Growth of a cost: ``seconds = prefactor · N^exponent``, by least squares in logarithms."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class PowerLaw:
    """Exponent with its standard error, from the scatter about the line, and seconds at N = 1."""

    exponent: float
    standard_error: float
    prefactor: float


def fit_power_law(beads: Sequence[float], seconds: Sequence[float]) -> PowerLaw:
    """Fit ``log seconds = log prefactor + exponent · log N``; three points at least."""
    x, y = np.log(np.asarray(beads, dtype=float)), np.log(np.asarray(seconds, dtype=float))
    off = x - x.mean()
    exponent = (off * y).sum() / (off**2).sum()
    level = y.mean() - exponent * x.mean()
    scatter = y - level - exponent * x
    error = np.sqrt((scatter**2).sum() / (len(x) - 2) / (off**2).sum())
    return PowerLaw(float(exponent), float(error), float(np.exp(level)))
