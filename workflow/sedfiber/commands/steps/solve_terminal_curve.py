"""``sedfiber solve_terminal_curve``: the terminal shapes of every ℬ of a range, as one series."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, write_terminal_curve


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    parser.add_argument("--B-min", required=True, help="smallest elasto-gravitational number")
    parser.add_argument("--B-max", required=True, help="largest elasto-gravitational number")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--hydrodynamics", default=Scene.hydrodynamics, help=f"mobility ({Scene.hydrodynamics})")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Solve, print how many terms the series took, write."""
    low, high = (Scene(B, 0.0, args.n_beads, hydrodynamics=args.hydrodynamics) for B in (args.B_min, args.B_max))
    require_writable(args.output)
    curve = TerminalCurve.between(low.B, high.B, low.n_beads, low.hydrodynamics)
    print(f"{len(curve.coefficients)} terms from B={curve.B_min:g} to {curve.B_max:g}")
    write_terminal_curve(curve, args.output)
