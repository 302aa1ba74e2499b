"""``sedfiber compare_third_dimension``: out-of-plane growth at each ℬ, predicted and run; where it turns."""

import math
from collections.abc import Sequence
from dataclasses import replace

import pandas as pd

from sedfiber.commands.steps._step import Output
from sedfiber.core.csv_file import write_csv
from sedfiber.core.validation import positive_number
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.plane_stability import Growth, terminal_rate, threshold, watch
from sedfiber.simulation.run import simulate

NEAR = 1e-3  # how near to the threshold, to both sides, the runs in volume still tell which side they are on


def run(
    *,
    growth: Output,
    output: Output,
    B: Sequence[float],
    n_beads: int,
    hydrodynamics: str,
    amplitude: float,  # a, displacement out of the plane at the start
    t_end: float,
) -> None:
    """Predict and run at each ℬ, and just below and above the threshold between the first and the last."""
    values = sorted(positive_number("B", value) for value in B)
    scene = Scene(values[0], math.pi / 4, n_beads, hydrodynamics=hydrodynamics)
    ends = positive_number("amplitude", amplitude), positive_number("t_end", t_end)
    turn = threshold(scene, values[0], values[-1])
    cases = [(one, "") for one in values]
    cases += [(turn * (1 - NEAR), "below"), (turn, "threshold"), (turn * (1 + NEAR), "above")]
    rows, growths = [], []
    for at, place in sorted(cases):
        here = replace(scene, B=at)
        grown = watch(here, *ends)
        rows.append(_row(here, place, grown))
        growths.append(pd.DataFrame({"B": at, "t": grown.t, "amplitude": grown.amplitude}))
    table = pd.DataFrame(rows)
    print(table.to_string(index=False))
    write_csv(table, output)
    write_csv(pd.concat(growths, ignore_index=True), growth)


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
