"""``sedfiber simulate``: integrate a scene, of a file or of options, and write its trajectory."""

import argparse
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from sedfiber.core.atomic_file import require_parquet
from sedfiber.core.errors import InputError
from sedfiber.core.progress_bar import simulated_time
from sedfiber.physics.integrators import INTEGRATORS, STOCHASTIC
from sedfiber.scene.fields import HYDRODYNAMICS, SPACES
from sedfiber.scene.numerics import DEFAULT_INTEGRATOR, Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory_file import write_trajectory
from sedfiber.study.angles import angle_index, angle_of

_OPTIONS = ("B", "theta0", "n_beads", "space", "hydrodynamics", "shape", "tilt", "seed")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene and Numerics say what is allowed."""
    parser.add_argument("scene", nargs="?", type=Path, help="YAML file of the scene; options below change its values")
    parser.add_argument("--B", help="elasto-gravitational number")
    angle = parser.add_mutually_exclusive_group()
    angle.add_argument("--theta0", help="initial inclination to the x-axis, radians")
    angle.add_argument("--angle-index", help="the same as k in θ0 = k π/48")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")
    parser.add_argument("--n-beads", help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--space", help=f"{' or '.join(SPACES)} ({Scene.space})")
    parser.add_argument("--hydrodynamics", help=f"{' or '.join(HYDRODYNAMICS)} ({Scene.hydrodynamics})")
    parser.add_argument("--shape", help="start shape, turned by θ0: rest, or a file: .csv, .npy, .parquet (straight)")
    parser.add_argument("--tilt", help=f"replaces θ0 = 0, radians; 0 for exact symmetry ({Scene.tilt:g})")
    parser.add_argument("--seed", help=f"draws the sign of the tilt, disturbance and noise ({Scene.seed})")
    parser.add_argument(
        "--t-end", help="end of the run, a/U_s: its last sample is at or before it (when the fiber has settled)"
    )
    names = ", ".join((*INTEGRATORS, STOCHASTIC))
    parser.add_argument("--integrator", help=f"{names} ({DEFAULT_INTEGRATOR}; with noise {STOCHASTIC})")
    parser.add_argument("--rtol", help=f"relative tolerance ({Numerics.rtol:g})")
    parser.add_argument("--atol", help=f"absolute tolerance, a ({Numerics.atol:g})")
    parser.add_argument("--interval", help=f"sample spacing, a/U_s ({Numerics.interval})")
    parser.add_argument(
        "--estimate-error", action="store_true", default=None, help="record how far a run at tighter tolerances is off"
    )
    parser.add_argument("--max-time", help=f"settle by this time or fail, a/U_s ({Numerics.max_time:g})")


def run(args: argparse.Namespace) -> None:
    """Validate everything, integrate, write, and say what left-out effects would have done."""
    index = None if args.angle_index is None else angle_index(args.angle_index)
    scene, numerics = _requested(args, index)
    require_parquet(args.output)
    with simulated_time() as progress:
        trajectory = simulate(scene, numerics, progress=progress)
    write_trajectory(trajectory.with_facts(angle_index=index), args.output)
    if trajectory.metadata["settled_to"] == "W":
        print("settled to the W, which is unstable to left-right asymmetry, and not to the terminal U")
    elif trajectory.settling_time is not None:
        print(f"settled to the U at t = {trajectory.settling_time:.4g} a/U_s")
    for verdict in trajectory.metadata["audit"]:
        print(verdict["words"])


def _requested(args: argparse.Namespace, index: int | None) -> tuple[Scene, Numerics]:
    """The file's scene with the options' values, or the options' alone."""
    what = _given(args, _OPTIONS)
    if what.get("shape") not in (None, "rest", "straight"):
        what["shape"] = {"file": what["shape"]}
    if index is not None:
        what["theta0"] = angle_of(index)
    how = _given(args, Numerics.__dataclass_fields__)
    if args.scene is not None:
        from sedfiber.scene.scene_file import read_scene  # YAML: the study's 227 runs do without

        scene, numerics = read_scene(args.scene, **what)
        return scene, replace(numerics, **how)
    for key, option in (("B", "--B"), ("theta0", "--theta0 or --angle-index")):
        if key not in what:
            raise InputError(f"{key}: missing; give {option}, or a scene file")
    return Scene(**what), Numerics(**how)


def _given(args: argparse.Namespace, keys: Iterable[str]) -> dict:
    """The options that were given; the scene's or the defaults stand for the rest."""
    values = {key: getattr(args, key) for key in keys}
    return {key: value for key, value in values.items() if value is not None}
