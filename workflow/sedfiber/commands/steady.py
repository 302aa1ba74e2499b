"""``sedfiber steady``: terminal shape and speed at one elasto-gravitational number."""

import argparse
import json

from sedfiber.physics.steady import SteadyState, steady_state
from sedfiber.scene import HYDRODYNAMICS, Scene


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument(
        "--hydrodynamics",
        default=Scene.hydrodynamics,
        help=f"{' or '.join(HYDRODYNAMICS)} ({Scene.hydrodynamics})",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(args: argparse.Namespace) -> None:
    """Solve and print: lengths in a, speeds in U_s."""
    scene = Scene(args.B, 0.0, args.n_beads, hydrodynamics=args.hydrodynamics)
    summary = _summary(steady_state(scene.B, scene.n_beads, scene.hydrodynamics), scene)
    if args.json:
        print(json.dumps(summary))
        return
    for key, value in summary.items():
        print(f"{key:20s} {value}")


def _summary(state: SteadyState, scene: Scene) -> dict:
    return {
        "B": state.B,
        "B_force_consistent": scene.force_consistent_B,
        "modulus": scene.modulus,
        "n_beads": scene.n_beads,
        "velocity": state.speed,
        "height": state.height,
        "end_to_end": state.end_to_end,
        "residual": state.residual,
    }
