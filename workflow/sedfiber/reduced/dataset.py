"""The trajectories that the models learn from and are tested on.

Lengths are in bead radii ``a``, times in ``a/U_s``, as in the files; `scaling` rescales.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow.parquet as pq

from sedfiber.core.array_types import Array, History, Positions, Times
from sedfiber.core.errors import InputError

if TYPE_CHECKING:
    import pandas as pd  # a forecast does without

AXES = ("x", "y", "z")
MOVED = 1e-6  # a: the least that a settling fiber's centre bead moves in a sample interval


@dataclass(frozen=True)
class Trajectory:
    """One fiber settling, with the steady state that it settles onto.

    ``t`` has shape (T,) and starts at 0; ``positions`` (T, N, 3); ``terminal`` (N, 3) is
    relative to the centre bead; ``terminal_velocity`` (3,) is the steady falling velocity.
    """

    B: float
    angle_index: int
    theta0: float
    split: str
    t: Times
    positions: History
    terminal: Positions
    terminal_velocity: Array

    @property
    def name(self) -> str:
        """How messages call this trajectory."""
        return f"B = {self.B:g}, angle_index = {self.angle_index}"


@dataclass(frozen=True)
class Dataset:
    """Trajectories of one fiber, all with the same number of beads."""

    trajectories: tuple[Trajectory, ...]

    def __iter__(self) -> Iterator[Trajectory]:
        return iter(self.trajectories)

    def __len__(self) -> int:
        return len(self.trajectories)

    @property
    def n_beads(self) -> int:
        """Number of beads N."""
        return self.trajectories[0].positions.shape[1]

    @property
    def B_values(self) -> Array:
        """The distinct elasto-gravitational numbers, ascending, shape (K,)."""
        return np.unique([trajectory.B for trajectory in self])

    @property
    def names(self) -> list[str]:
        """How messages call each trajectory."""
        return [trajectory.name for trajectory in self]

    def require_sound(self) -> None:
        """Raise InputError, naming the trajectory, for one that nothing can be learned from."""
        if not self.trajectories:
            raise InputError("the data set is empty; give at least one trajectory")
        for trajectory in self:
            _require_finite(trajectory)
            _require_samples(trajectory)
            _require_motion(trajectory)

    def split(self, label: str) -> "Dataset":
        """The trajectories of one split (``train``, ``A`` or ``B``).

        Raises InputError when there are none.
        """
        chosen = tuple(trajectory for trajectory in self if trajectory.split == label)
        if not chosen:
            raise InputError(f"the data set has no trajectories in split {label!r}")
        return Dataset(chosen)


def read_dataset(samples: str | Path, terminal_shapes: str | Path) -> Dataset:
    """Read the Parquet pair: all samples, and the terminal shape of every ℬ.

    Raises InputError for an unreadable file, a missing column, a missing terminal shape,
    and for a trajectory with a value that is not finite.
    """
    table, steady = _read_parquet(samples), _read_parquet(terminal_shapes)
    columns = _position_columns(table, samples)
    terminal = {row["B"]: row for _, row in steady.iterrows()}
    groups = table.groupby(["B", "angle_index"], sort=True)
    return Dataset(tuple(_trajectory(group, columns, terminal) for _, group in groups))


def mirrored(positions: Array) -> Array:
    """The mirror image ``x → −x`` with the bead order reversed; turns θ₀ into −θ₀.

    ``positions`` has shape (…, N, 3) and so has the result.
    """
    return positions[..., ::-1, :] * np.array([-1.0, 1.0, 1.0])


def centre_index(n_beads: int) -> int:
    """Index of the centre bead."""
    return n_beads // 2


def _read_parquet(path: str | Path) -> "pd.DataFrame":
    try:
        return pq.read_table(path, page_checksum_verification=True).to_pandas()
    except (OSError, ValueError) as error:
        raise InputError(f"cannot read {path} as Parquet: {str(error).splitlines()[0]}") from error


def _position_columns(table: "pd.DataFrame", path: str | Path) -> list[str]:
    n_beads = sum(name.startswith("x") and name[1:].isdigit() for name in table.columns)
    wanted = [f"{axis}{bead}" for bead in range(n_beads) for axis in AXES]
    required = [*wanted, "B", "theta0", "angle_index", "split", "t"]
    missing = [name for name in required if name not in table.columns]
    if missing or n_beads == 0:
        raise InputError(f"{path} lacks the columns {missing or 'x0, y0, z0, …'}")
    return wanted


def _trajectory(group: "pd.DataFrame", columns: list[str], terminal: dict) -> Trajectory:
    first = group.iloc[0]
    if first["B"] not in terminal:
        raise InputError(f"there is no terminal shape for B = {first['B']:g}")
    steady = terminal[first["B"]]
    trajectory = Trajectory(
        B=float(first["B"]),
        angle_index=int(first["angle_index"]),
        theta0=float(first["theta0"]),
        split=str(first["split"]),
        t=group["t"].to_numpy(dtype=float),
        positions=group[columns].to_numpy(dtype=float).reshape(len(group), -1, 3),
        terminal=steady[columns].to_numpy(dtype=float).reshape(-1, 3),
        terminal_velocity=steady[[f"velocity_{axis}" for axis in AXES]].to_numpy(dtype=float),
    )
    _require_finite(trajectory)
    return trajectory


def _require_finite(trajectory: Trajectory) -> None:
    arrays = (trajectory.t, trajectory.positions, trajectory.terminal, trajectory.terminal_velocity)
    if not all(np.isfinite(array).all() for array in arrays):
        raise _unsound(trajectory, "holds values that are not finite")


def _require_samples(trajectory: Trajectory) -> None:
    """Rates are differences of samples: there must be two, and time must pass between them."""
    t = trajectory.t
    if len(t) < 2 or len(t) != len(trajectory.positions):
        raise _unsound(trajectory, f"has {len(t)} times and {len(trajectory.positions)} samples, not 2 or more of both")
    if t[0] != 0.0 or not (np.diff(t) > 0).all():
        raise _unsound(trajectory, "has times that do not ascend from zero")


def _require_motion(trajectory: Trajectory) -> None:
    """The path's length and the distance travelled are divided by."""
    centre = trajectory.positions[:, trajectory.positions.shape[1] // 2]
    still = np.flatnonzero(np.linalg.norm(centre[1:] - centre[0], axis=1) < MOVED)
    if still.size:
        when = trajectory.t[1 + still[-1]]
        raise _unsound(trajectory, f"does not settle: at t = {when:g} its centre bead is where it started")


def _unsound(trajectory: Trajectory, what: str) -> InputError:
    return InputError(f"the trajectory with {trajectory.name} {what}; simulate it again, or leave it out")
