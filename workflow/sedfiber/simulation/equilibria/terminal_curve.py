"""The terminal U of every ℬ of a range at once: a Chebyshev series instead of a steady solve.

    X_term(ℬ), U_term(ℬ) = Σ_k c_k T_k(b),    b = 2 ln(ℬ/ℬ_min)/ln(ℬ_max/ℬ_min) − 1,    k = 0 … K − 1

A forecast needs shape and velocity at its ℬ; the solve costs a hundred times what the rest of
the forecast does, the series a few microseconds.
"""

from dataclasses import dataclass
from math import log
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from sedfiber.core.array_types import Array, Positions
from sedfiber.core.errors import InputError, NumericalError
from sedfiber.core.parquet_file import column_values, read_table, write_table

if TYPE_CHECKING:
    from sedfiber.simulation.equilibria.steady import SteadyState

FILE = "terminal_curve.parquet"  # beside a forecast model
ACCURACY = 1e-9  # a and U_s: the last coefficients are smaller
_FIRST_DEGREE, _LARGEST_DEGREE = 32, 1024
_TAIL = 4  # last coefficients looked at: single ones may be small by chance


@dataclass(frozen=True)
class TerminalCurve:
    """Terminal shapes and velocities for ℬ from ``B_min`` to ``B_max``.

    ``coefficients`` (K, 2N + 2): of x, y of each bead relative to the centre bead in units of a,
    and of the two components of the velocity in U_s.
    """

    B_min: float
    B_max: float
    hydrodynamics: str
    coefficients: Array

    @classmethod
    def between(cls, B_min: float, B_max: float, n_beads: int = 31, hydrodynamics: str = "RPY") -> "TerminalCurve":
        """Solve at Chebyshev points, twice as many until the series has converged.

        A range of one ℬ has one term.  Raises InputError for values that are not allowed, NumericalError
        where a ℬ of the range has no terminal shape or the series does not converge.
        """
        from sedfiber.simulation.equilibria.steady import steady_state  # compiled: a forecast only reads the series

        if not 0.0 < B_min <= B_max:
            raise InputError(f"B_max: {B_max:g} is not allowed; give a number from B_min={B_min:g} up")
        if B_min == B_max:
            return cls(B_min, B_max, hydrodynamics, _row(steady_state(B_min, n_beads, hydrodynamics))[None])
        solved: dict[float, Array] = {}
        degree = _FIRST_DEGREE
        while degree <= _LARGEST_DEGREE:
            b = np.cos(np.pi * np.arange(degree + 1) / degree)  # every second one is known already
            for at in b:
                if at not in solved:
                    B = B_min * (B_max / B_min) ** ((1.0 + at) / 2.0)
                    solved[at] = _row(steady_state(B, n_beads, hydrodynamics))
            series = np.linalg.solve(chebvander(b, degree), np.array([solved[at] for at in b]))
            if np.abs(series[-_TAIL:]).max() < ACCURACY:
                return cls(B_min, B_max, hydrodynamics, series)
            degree *= 2
        raise NumericalError(
            f"terminal curve: no series of degree {_LARGEST_DEGREE} follows the terminal shapes "
            f"from B={B_min:g} to {B_max:g}; give a smaller range"
        )

    @property
    def n_beads(self) -> int:
        """Number of beads N."""
        return self.coefficients.shape[1] // 2 - 1

    def covers(self, B: float) -> bool:
        """Whether ``B`` is within the range."""
        return self.B_min <= B <= self.B_max

    def __call__(self, B: float) -> tuple[Positions, Array]:
        """Terminal shape (N, 3) relative to the centre bead and velocity (3,) at a ``B`` of the range."""
        terms = np.arange(len(self.coefficients))
        row = np.cos(terms * np.arccos(self._place(B))) @ self.coefficients
        shape, velocity = np.zeros((self.n_beads, 3)), np.zeros(3)
        shape[:, :2], velocity[:2] = row[:-2].reshape(-1, 2), row[-2:]
        return shape, velocity

    def _place(self, B: float) -> float:
        """b, not a rounding outside [−1, 1]."""
        if self.B_min == self.B_max:
            return 0.0
        b = 2.0 * log(B / self.B_min) / log(self.B_max / self.B_min) - 1.0
        return min(1.0, max(-1.0, b))


def write_terminal_curve(curve: TerminalCurve, path: Path) -> None:
    """One row per coefficient k: ``x0, y0, …, velocity_x, velocity_y``."""
    names = [f"{axis}{bead}" for bead in range(curve.n_beads) for axis in "xy"] + ["velocity_x", "velocity_y"]
    facts = {"B_min": curve.B_min, "B_max": curve.B_max, "hydrodynamics": curve.hydrodynamics}
    write_table(path, dict(zip(names, curve.coefficients.T, strict=True)), {"kind": "terminal curve", **facts})


def read_terminal_curve(path: Path) -> TerminalCurve:
    """Read the file of `write_terminal_curve`; raises InputError for any other."""
    table, facts = read_table(path)
    if facts.get("kind") != "terminal curve":
        raise InputError(f"input: {str(path)!r} holds no terminal curve")
    columns = np.column_stack([column_values(table, name) for name in table.column_names])
    return TerminalCurve(facts["B_min"], facts["B_max"], facts["hydrodynamics"], np.ascontiguousarray(columns))


def _row(state: "SteadyState") -> Array:
    return np.append(state.positions[:, :2].ravel(), state.velocity[:2])
