"""``sedfiber solve_terminal_curve``: the terminal shapes of every ℬ of a range, as one series."""

import argparse

from sedfiber.commands.steps._settings import add_settings_and_output, made_from
from sedfiber.core.atomic_file import require_writable
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, write_terminal_curve


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Values stay text here; Scene says what is allowed."""
    add_settings_and_output(parser, "Parquet file to write")


def run(args: argparse.Namespace) -> None:
    """Solve, print how many terms the series took, write."""
    low, high = made_from(args.settings, _ends)
    require_writable(args.output)
    curve = TerminalCurve.between(low.B, high.B, low.n_beads, low.hydrodynamics)
    print(f"{len(curve.coefficients)} terms from B={curve.B_min:g} to {curve.B_max:g}")
    write_terminal_curve(curve, args.output)


def _ends(
    B_min: float, B_max: float, n_beads: int = Scene.n_beads, hydrodynamics: str = Scene.hydrodynamics
) -> tuple[Scene, Scene]:
    """The scenes at both ends of the range."""
    low, high = (Scene(B, 0.0, n_beads, hydrodynamics=hydrodynamics) for B in (B_min, B_max))
    return low, high
