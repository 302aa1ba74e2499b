"""``sedfiber check_simulation``: one run again with another method and tighter tolerance."""

import json
from pathlib import Path

from sedfiber.commands.steps._step import Output
from sedfiber.core.atomic_file import write_text
from sedfiber.core.errors import NumericalError
from sedfiber.core.validation import positive_number
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory_file import read_trajectory


def run(trajectory: Path, *, output: Output, integrator: str, tolerance: float, bound: float) -> None:
    """Simulate again to the same end, compare at every sample, write or fail.

    ``tolerance`` is relative and absolute; ``bound`` is the largest difference allowed, over L.
    """
    bound, tolerance = positive_number("bound", bound), positive_number("tolerance", tolerance)
    first = read_trajectory(trajectory)
    values = {key: value for key, value in first.metadata["scene"].items() if key != "start_angle"}
    numerics = Numerics(integrator, tolerance, tolerance, first.metadata["numerics"]["interval"])
    second = simulate(Scene.from_dict(values), numerics, t_end=float(first.t[-1]))
    difference = largest_distance(first.positions, second.positions, first.length)
    if not difference <= bound:
        raise NumericalError(f"runs differ by {difference:.3g} L, more than {bound:g} L; try a smaller rtol")
    facts = {key: first.metadata[key] for key in ("B", "angle_index")}
    facts |= {"integrator": integrator, "tolerance": tolerance, "difference": difference, "bound": bound}
    write_text(output, json.dumps(facts, sort_keys=True) + "\n")
