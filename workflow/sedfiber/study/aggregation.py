"""The data set and the table of facts from one file per trajectory, keyed by (ℬ, angle_index)."""

from pathlib import Path

import pandas as pd

from sedfiber.core.errors import InputError
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.simulation.trajectory_file import read_trajectory

CHECK_COLUMNS = ("bond_strain_max", "smallest_gap", "energy_imbalance", "final_distance")


def read_runs(paths: list[Path], split: str) -> list[Trajectory]:
    """Read the files, sorted by (ℬ, angle_index); raises InputError when they do not belong together."""
    runs = [_read_run(path, split) for path in paths]
    beads = sorted({run.positions.shape[1] for run in runs})
    if len(beads) != 1:
        raise InputError(f"dataset: trajectories have different bead counts {beads}")
    return sorted(runs, key=lambda run: (run.B, run.angle_index))


def facts_table(runs: list[Trajectory]) -> pd.DataFrame:
    """One row per trajectory: settling time, counters, checks and estimated error."""
    return pd.DataFrame([_facts(run) for run in runs])


def _read_run(path: Path, split: str) -> Trajectory:
    run = read_trajectory(path)
    if run.metadata.get("angle_index") is None:
        raise InputError(f"dataset: {str(path)!r} has no angle_index; simulate it with --angle-index")
    return run.with_facts(split=split)


def _facts(run: Trajectory) -> dict:
    meta = run.metadata
    return {
        "split": run.split,
        "B": run.B,
        "angle_index": run.angle_index,
        "B_force_consistent": meta["B_force_consistent"],
        "start_angle": run.theta0,
        "settled_to": meta["settled_to"],
        "settling_time": meta["settling_time"],
        "samples": len(run.t),
        "integrator": meta["numerics"]["integrator"],
        "rtol": meta["numerics"]["rtol"],
        **meta["counters"],
        **{name: meta["checks"][name] for name in CHECK_COLUMNS},
        "error_estimate": meta["error_estimate"],
    }
