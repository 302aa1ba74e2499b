"""``sedfiber solve_terminal_shapes``: steady shapes of several ℬ in one table."""

import argparse
from pathlib import Path

from sedfiber.core.atomic_file import require_writable
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import steady_state
from sedfiber.simulation.equilibria.terminal_shapes import write_terminal_shapes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    parser.add_argument("--B", nargs="+", required=True, help="elasto-gravitational numbers")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--hydrodynamics", default=Scene.hydrodynamics, help=f"mobility ({Scene.hydrodynamics})")
    parser.add_argument("-o", "--output", type=Path, required=True, help="Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Solve at every ℬ and write one row each."""
    scenes = [Scene(B, 0.0, args.n_beads, hydrodynamics=args.hydrodynamics) for B in args.B]
    require_writable(args.output)
    states = [steady_state(scene.B, scene.n_beads, scene.hydrodynamics) for scene in scenes]
    write_terminal_shapes(states, args.output)
