"""The steady shape and velocity of several ℬ as one table."""

from pathlib import Path

import numpy as np

from sedfiber.core.parquet_file import coordinate_columns, write_table
from sedfiber.simulation.equilibria.steady import SteadyState


def write_terminal_shapes(states: list[SteadyState], path: Path) -> None:
    """One row per ℬ: ``B, velocity_x, …, residual, x0, y0, z0, …`` in units of a and U_s."""
    velocities = np.array([state.velocity for state in states])
    columns = {"B": np.array([state.B for state in states])}
    columns |= {f"velocity_{axis}": velocities[:, k] for k, axis in enumerate("xyz")}
    columns["residual"] = np.array([state.residual for state in states])
    columns |= coordinate_columns(np.array([state.positions for state in states]))
    write_table(path, columns, {"kind": "terminal shapes"})
