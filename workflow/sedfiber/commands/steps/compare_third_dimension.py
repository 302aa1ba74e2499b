"""``sedfiber compare_third_dimension``: out-of-plane growth at each ℬ, predicted and run; where it turns."""

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pandas as pd

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.plane_stability import Growth, terminal_rate, threshold, watch
from sedfiber.simulation.run import simulate

NEAR = 1e-3  # how near to the threshold, to both sides, the runs in volume still tell which side they are on


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to look, how, and the two tables to write."""
    parser.add_argument("--growth", type=Path, required=True, help="CSV file for the amplitudes over time")
    add_settings_and_output(parser, "CSV file to write, a row for each ℬ")


def run(args: argparse.Namespace) -> None:
    """Predict and run at each ℬ, and just below and above the threshold between the first and the last."""
    for path in (args.output, args.growth):
        require_writable(path)
    values, scene, amplitude, t_end = made_from(args.settings, _asked)
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


def _asked(
    B: Sequence[float], n_beads: int, hydrodynamics: str, amplitude: float, t_end: float
) -> tuple[list[float], Scene, float, float]:
    """ℬ in order, the scene at the first, the displacement out of the plane at the start (a) and the runs' end."""
    values = sorted(positive_number("B", value) for value in B)
    scene = Scene(values[0], math.pi / 4, n_beads, hydrodynamics=hydrodynamics)
    return values, scene, positive_number("amplitude", amplitude), positive_number("t_end", t_end)


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
