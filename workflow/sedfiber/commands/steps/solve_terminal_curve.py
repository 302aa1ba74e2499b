"""``sedfiber solve_terminal_curve``: the terminal shapes of every ℬ of a range, as one series."""

from sedfiber.commands.steps._step import Output
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, write_terminal_curve


def run(
    *,
    output: Output,
    B_min: float,
    B_max: float,
    n_beads: int = Scene.n_beads,
    hydrodynamics: str = Scene.hydrodynamics,
) -> None:
    """Solve, print how many terms the series took, write."""
    low, high = (Scene(B, 0.0, n_beads, hydrodynamics=hydrodynamics) for B in (B_min, B_max))
    curve = TerminalCurve.between(low.B, high.B, low.n_beads, low.hydrodynamics)
    print(f"{len(curve.coefficients)} terms from B={curve.B_min:g} to {curve.B_max:g}")
    write_terminal_curve(curve, output)
