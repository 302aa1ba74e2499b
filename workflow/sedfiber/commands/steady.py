"""``sedfiber steady``: steady shape, speed and growth rates at one elasto-gravitational number."""

import argparse
import json
from pathlib import Path

from sedfiber.core.atomic_file import require_writable, write_text
from sedfiber.scene.fields import HYDRODYNAMICS
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.spectrum import spectrum
from sedfiber.simulation.equilibria.steady import BRANCHES, SteadyState, terminal_state

UNITS = {
    "velocity": "U_s",
    "height": "a",
    "end_to_end": "a",
    "residual": "U_s",
    "in_plane_rate": "U_s/a",
    "out_of_plane_rate": "U_s/a",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    parser.add_argument("--B", required=True, help="elasto-gravitational number")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument(
        "--hydrodynamics",
        default=Scene.hydrodynamics,
        help=f"{' or '.join(HYDRODYNAMICS)} ({Scene.hydrodynamics})",
    )
    parser.add_argument("--branch", default="U", help=f"{' or '.join(BRANCHES)}, which is unstable (U)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        help="CSV file for the shape: x, y, z of each bead in a, as scenes take it",
    )


def run(args: argparse.Namespace) -> None:
    """Solve and print: lengths in a, speeds in U_s, growth rates in U_s/a."""
    scene = Scene(args.B, 0.0, args.n_beads, hydrodynamics=args.hydrodynamics)
    if args.output is not None:
        require_writable(args.output)
    state = terminal_state(scene, args.branch)
    summary = _summary(state, scene)
    if args.output is not None:
        write_text(args.output, "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in state.positions.tolist()))
    if args.json:
        print(json.dumps(summary))
        return
    for key, value in summary.items():
        print(f"{key:20s} {value} {UNITS.get(key, '')}".rstrip())


def _summary(state: SteadyState, scene: Scene) -> dict:
    modes = spectrum(scene, state.positions)
    return {
        "B": state.B,
        "B_force_consistent": scene.force_consistent_B,
        "modulus": scene.modulus,
        "n_beads": scene.n_beads,
        "branch": state.branch,
        "velocity": state.speed,
        "height": state.height,
        "end_to_end": state.end_to_end,
        "residual": state.residual,
        "in_plane_rate": modes.in_plane_rate,
        "out_of_plane_rate": modes.out_of_plane_rate,
        "stable_in_plane": modes.stable_in_plane,
        "stable_in_volume": modes.stable_in_volume,
    }
