"""``sedfiber simulate``: integrate one fiber and write its trajectory."""

import argparse
import math
from dataclasses import replace
from pathlib import Path

from sedfiber.atomic_file import require_writable
from sedfiber.physics.integrators import INTEGRATORS
from sedfiber.scene import HYDRODYNAMICS, SPACES, Scene
from sedfiber.simulation import Numerics, simulate
from sedfiber.trajectory_file import write_trajectory
from sedfiber.validation import positive_number, whole_number

ANGLES_PER_HALF_TURN = 48  # the study's grid of inclinations is k π/48


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene and Numerics say what is allowed."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    angle = parser.add_mutually_exclusive_group(required=True)
    angle.add_argument("--theta0", help="initial inclination to the x-axis, radians")
    angle.add_argument("--angle-index", help="the same as k in θ0 = k π/48")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")
    parser.add_argument("--n-beads", help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--space", help=f"{' or '.join(SPACES)} ({Scene.space})")
    parser.add_argument("--hydrodynamics", help=f"{' or '.join(HYDRODYNAMICS)} ({Scene.hydrodynamics})")
    parser.add_argument("--tilt", help=f"replaces θ0 = 0, radians; 0 for exact symmetry ({Scene.tilt:g})")
    parser.add_argument("--seed", help=f"draws the sign of the tilt ({Scene.seed})")
    parser.add_argument("--t-end", help="end of the run, a/U_s (when the fiber has settled)")
    parser.add_argument("--integrator", help=f"{', '.join(INTEGRATORS)} ({Numerics.integrator})")
    parser.add_argument("--rtol", help=f"relative tolerance ({Numerics.rtol:g})")
    parser.add_argument("--atol", help=f"absolute tolerance, a ({Numerics.atol:g})")
    parser.add_argument("--interval", help=f"sample spacing, a/U_s ({Numerics.interval})")
    parser.add_argument("--max-time", help=f"settle by this time or fail, a/U_s ({Numerics.max_time:g})")


def run(args: argparse.Namespace) -> None:
    """Validate everything, integrate, write."""
    index = None if args.angle_index is None else _angle_index(args.angle_index)
    theta0 = args.theta0 if index is None else index * math.pi / ANGLES_PER_HALF_TURN
    scene = Scene(**_given(args, Scene) | {"theta0": theta0})
    numerics = Numerics(**_given(args, Numerics))
    t_end = None if args.t_end is None else positive_number("t_end", args.t_end)
    require_writable(args.output)
    trajectory = simulate(scene, numerics, t_end)
    labelled = replace(trajectory, metadata=trajectory.metadata | {"angle_index": index})
    write_trajectory(labelled, args.output)


def _given(args: argparse.Namespace, kind: type) -> dict:
    """The options of ``kind`` that were given; its own defaults stand for the rest."""
    values = {key: getattr(args, key) for key in kind.__dataclass_fields__}
    return {key: value for key, value in values.items() if value is not None}


def _angle_index(value: str) -> int:
    """k in θ₀ = k π/48; files and keys hold k, never a rounded angle."""
    most = ANGLES_PER_HALF_TURN
    return whole_number("angle_index", value, f"a whole number from 0 to {most}", 0, most)
