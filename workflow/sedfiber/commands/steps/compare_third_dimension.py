"""``sedfiber compare_third_dimension``: out-of-plane growth at each ℬ, predicted and run; where it turns."""

import argparse
from dataclasses import replace
from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.plane_stability import Growth, terminal_rate, threshold, watch
from sedfiber.simulation.run import simulate

NEAR = 1e-3  # how near to the threshold, to both sides, the runs in volume still tell which side they are on


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to look, how, and the two tables to write."""
    parser.add_argument("--B", nargs="+", required=True, help="elasto-gravitational numbers, the threshold among them")
    parser.add_argument("--theta0", default=0.7853981633974483, help="start of the runs, radians (π/4)")
    parser.add_argument("--n-beads", default=Scene.n_beads, help=f"odd number of beads ({Scene.n_beads})")
    parser.add_argument("--hydrodynamics", default=Scene.hydrodynamics, help=f"as of simulate ({Scene.hydrodynamics})")
    parser.add_argument("--amplitude", default=1e-4, help="displacement out of the plane at the start, a (1e-4)")
    parser.add_argument("--t-end", default=800, help="end of the runs in volume, a/U_s (800)")
    parser.add_argument("--growth", type=Path, required=True, help="CSV file for the amplitudes over time")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write, a row for each ℬ")


def run(args: argparse.Namespace) -> None:
    """Predict and run at each ℬ, and just below and above the threshold between the first and the last."""
    for path in (args.output, args.growth):
        require_writable(path)
    values = sorted(positive_number("B", value) for value in args.B)
    amplitude, t_end = positive_number("amplitude", args.amplitude), positive_number("t_end", args.t_end)
    scene = Scene(values[0], args.theta0, args.n_beads, hydrodynamics=args.hydrodynamics)
    turn = threshold(scene, values[0], values[-1])
    cases = [(B, "") for B in values]
    cases += [(turn * (1 - NEAR), "below"), (turn, "threshold"), (turn * (1 + NEAR), "above")]
    rows, growths = [], []
    for B, place in sorted(cases):
        here = replace(scene, B=B)
        growth = watch(here, amplitude, t_end)
        rows.append(_row(here, place, growth))
        growths.append(pd.DataFrame({"B": B, "t": growth.t, "amplitude": growth.amplitude}))
    table = pd.DataFrame(rows)
    print(table.to_string(index=False))
    write_csv(table, args.output)
    write_csv(pd.concat(growths, ignore_index=True), args.growth)


def _row(scene: Scene, place: str, growth: Growth) -> dict:
    """Rates in U_s/a: of the terminal shape, of the planar run's audit, and measured in volume."""
    verdict = next(v for v in simulate(scene).metadata["audit"] if v["effect"] == "third dimension")
    return {
        "B": scene.B,
        "place": place,
        "predicted_rate": terminal_rate(scene),
        "audit_rate": verdict["number"],
        "audit_matters": verdict["matters"],
        "measured_rate": growth.rate,
        "measured_matters": bool(growth.rate > 0.0),
        "amplitude_start": growth.amplitude[0],
        "amplitude_largest": growth.amplitude.max(),
        "amplitude_end": growth.amplitude[-1],
    }
