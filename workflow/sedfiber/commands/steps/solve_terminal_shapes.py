"""``sedfiber solve_terminal_shapes``: steady shapes of several ℬ in one table."""

from collections.abc import Sequence

from sedfiber.commands.steps._step import Output
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import steady_state
from sedfiber.simulation.equilibria.terminal_shapes import write_terminal_shapes


def run(
    *,
    output: Output,
    B: Sequence[float],
    n_beads: int = Scene.n_beads,
    hydrodynamics: str = Scene.hydrodynamics,
) -> None:
    """Solve at every ℬ and write one row each."""
    scenes = [Scene(one, 0.0, n_beads, hydrodynamics=hydrodynamics) for one in B]
    states = [steady_state(scene.B, scene.n_beads, scene.hydrodynamics) for scene in scenes]
    write_terminal_shapes(states, output)
