"""From one file per trajectory to one table per split, keyed by (ℬ, angle_index)."""

from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa

from sedfiber.errors import InputError
from sedfiber.trajectory import Trajectory
from sedfiber.trajectory_file import coordinate_names, read_trajectory

CHECK_COLUMNS = ("bond_strain_max", "smallest_gap", "energy_imbalance", "final_distance")


def read_all(paths: list[Path]) -> list[Trajectory]:
    """Read the files, sorted by (ℬ, angle_index); all must have the same number of beads."""
    trajectories = [read_trajectory(path) for path in paths]
    beads = {trajectory.n_beads for trajectory in trajectories}
    if len(beads) != 1:
        raise InputError(f"dataset: trajectories have different bead counts {sorted(beads)}")
    for trajectory, path in zip(trajectories, paths, strict=True):
        if trajectory.metadata.get("angle_index") is None:
            raise InputError(f"dataset: {str(path)!r} has no angle_index; simulate it with --angle-index")
    return sorted(trajectories, key=_key)


def samples_table(trajectories: list[Trajectory], split: str) -> pa.Table:
    """All samples: ``split, B, angle_index, theta0, t, x0, y0, z0, …``."""
    lengths = [len(trajectory.t) for trajectory in trajectories]
    scenes = [trajectory.metadata["scene"] for trajectory in trajectories]
    flat = np.concatenate([t.positions.reshape(len(t.t), -1) for t in trajectories]).T
    columns = {
        "split": pa.array([split] * sum(lengths)),
        "B": pa.array(np.repeat([scene["B"] for scene in scenes], lengths)),
        "angle_index": pa.array(np.repeat([_key(t)[1] for t in trajectories], lengths), pa.int32()),
        "theta0": pa.array(np.repeat([scene["start_angle"] for scene in scenes], lengths)),
        "t": pa.array(np.concatenate([trajectory.t for trajectory in trajectories])),
    }
    names = coordinate_names(trajectories[0].n_beads)
    return pa.table(columns | {name: pa.array(column) for name, column in zip(names, flat, strict=True)})


def facts_table(trajectories: list[Trajectory], split: str) -> pd.DataFrame:
    """One row per trajectory: settling time, counters and checks."""
    return pd.DataFrame([_facts(trajectory, split) for trajectory in trajectories])


def _facts(trajectory: Trajectory, split: str) -> dict:
    meta = trajectory.metadata
    return {
        "split": split,
        "B": meta["B"],
        "angle_index": meta["angle_index"],
        "B_force_consistent": meta["B_force_consistent"],
        "start_angle": meta["scene"]["start_angle"],
        "settling_time": meta["settling_time"],
        "samples": len(trajectory.t),
        "integrator": meta["numerics"]["integrator"],
        "rtol": meta["numerics"]["rtol"],
        **meta["counters"],
        **{name: meta["checks"][name] for name in CHECK_COLUMNS},
    }


def _key(trajectory: Trajectory) -> tuple[float, int]:
    return trajectory.metadata["B"], trajectory.metadata["angle_index"]
