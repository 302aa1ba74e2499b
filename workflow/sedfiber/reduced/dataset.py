"""The falls that the models learn from and are tested on.

Lengths are in bead radii ``a``, times in ``a/U_s``, as in the files; `scaling` rescales.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sedfiber.core.array_types import Array, Positions
from sedfiber.core.errors import InputError
from sedfiber.core.parquet_file import coordinate_names
from sedfiber.reduced.dataset_file import read_falls, read_frame
from sedfiber.simulation.trajectory import Trajectory

MOVED = 1e-6  # a: the least that a settling fiber's centre bead moves in a sample interval


@dataclass(frozen=True, kw_only=True, repr=False)
class SettlingFall(Trajectory):
    """A fall of one fiber from time 0 on, with the steady state that it settles onto.

    ``terminal`` (N, 3) is relative to the centre bead; ``terminal_velocity`` (3,) is the steady
    falling velocity.
    """

    terminal: Positions
    terminal_velocity: Array


@dataclass(frozen=True)
class Dataset:
    """Falls of one fiber, all with the same number of beads."""

    trajectories: tuple[SettlingFall, ...]

    def __iter__(self) -> Iterator[SettlingFall]:
        return iter(self.trajectories)

    def __len__(self) -> int:
        return len(self.trajectories)

    @property
    def n_beads(self) -> int:
        """Number of beads N."""
        return self.trajectories[0].n_beads

    @property
    def B_values(self) -> Array:
        """The distinct elasto-gravitational numbers, ascending, shape (K,)."""
        return np.unique([trajectory.B for trajectory in self])

    @property
    def names(self) -> list[str]:
        """The name of each trajectory in messages."""
        return [trajectory.name for trajectory in self]

    def require_sound(self) -> None:
        """Raise InputError, naming the trajectory, for one that nothing can be learned from."""
        if not self.trajectories:
            raise InputError("the data set is empty; give at least one trajectory")
        for trajectory in self:
            _require_finite(trajectory)
            _require_samples(trajectory)
            _require_motion(trajectory)


def read_dataset(samples: str | Path, terminal_shapes: str | Path) -> Dataset:
    """Read the Parquet pair: all samples, and the terminal shape of every ℬ.

    Raises InputError for an unreadable file, a missing column, a missing terminal shape,
    and for a trajectory with a value that is not finite.
    """
    falls = read_falls(samples)
    steady = {row["B"]: row for _, row in read_frame(terminal_shapes).iterrows()}
    return Dataset(tuple(_with_terminal(fall, steady) for fall in falls))


def mirrored(positions: Array) -> Array:
    """The mirror image ``x → −x`` with the bead order reversed; turns θ₀ into −θ₀.

    ``positions`` has shape (…, N, 3) and so has the result.
    """
    return positions[..., ::-1, :] * np.array([-1.0, 1.0, 1.0])


def _with_terminal(fall: Trajectory, steady: dict) -> SettlingFall:
    """The fall beside the row of its ℬ in the table of steady states."""
    if fall.B not in steady:
        raise InputError(f"there is no terminal shape for B = {fall.B:g}")
    row = steady[fall.B]
    settling = SettlingFall(
        fall.t,
        fall.positions,
        fall.metadata,
        terminal=row[coordinate_names(fall.n_beads)].to_numpy(dtype=float).reshape(-1, 3),
        terminal_velocity=row[[f"velocity_{axis}" for axis in "xyz"]].to_numpy(dtype=float),
    )
    _require_finite(settling)
    return settling


def _require_finite(trajectory: SettlingFall) -> None:
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
    centre = trajectory.centre
    still = np.flatnonzero(np.linalg.norm(centre[1:] - centre[0], axis=1) < MOVED)
    if still.size:
        when = trajectory.t[1 + still[-1]]
        raise _unsound(trajectory, f"does not settle: at t = {when:g} its centre bead is where it started")


def _unsound(trajectory: Trajectory, what: str) -> InputError:
    return InputError(f"the trajectory with {trajectory.name} {what}; simulate it again, or leave it out")
