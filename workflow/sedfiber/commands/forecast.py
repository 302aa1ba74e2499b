"""``sedfiber forecast``: forecast one fiber with the trained model."""

import argparse
import sys
from pathlib import Path

from sedfiber.atomic_file import require_writable
from sedfiber.errors import InputError
from sedfiber.scene import Scene
from sedfiber.trajectory_file import write_trajectory
from sedfiber.validation import positive_number

DEFAULT_MODEL = Path("results/models/forecast")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    parser.add_argument("--theta0", required=True, help="initial inclination to the x-axis, radians")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")
    parser.add_argument("--model", type=Path, default=DEFAULT_MODEL, help=f"model folder ({DEFAULT_MODEL})")
    parser.add_argument("--t-end", help="end of the forecast, a/U_s (when the fiber has settled)")
    parser.add_argument("--interval", default=0.5, help="sample spacing, a/U_s (0.5)")
    parser.add_argument("--shape", type=Path, help="start shape, turned by theta0: .csv, .npy, .parquet (straight)")
    parser.add_argument("--strict", action="store_true", help="refuse what would only be warned of")


def run(args: argparse.Namespace) -> None:
    """Validate, forecast, warn of what is not like the training, write."""
    scene = Scene(args.B, args.theta0)
    interval = positive_number("interval", args.interval)
    t_end = None if args.t_end is None else positive_number("t_end", args.t_end)
    require_writable(args.output)
    from sedfiber.forecasting import load_model  # its imports take a second: bad input fails before it

    shape = None if args.shape is None else {"file": args.shape}
    trajectory = load_model(args.model).settle(scene.B, scene.theta0, interval, t_end, shape)
    words = "; ".join(trajectory.metadata["model"]["warnings"])
    if words and args.strict:
        raise InputError(f"strict: {words}; give values of the training, or leave out --strict")
    if words:
        print(f"sedfiber forecast: warning: {words}", file=sys.stderr)
    write_trajectory(trajectory, args.output)
