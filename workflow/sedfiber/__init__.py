"""Flexible fibers that sink in a viscous fluid: simulation, steady shapes, reduced models.

Lengths are in bead radii ``a``, times in ``a/U_s``, forces in ``6πμaU_s``.
Public names are imported on first use, so that a simulation never pays for torch.
"""

from importlib import import_module
from typing import Any

_EXPORTS = {
    "InputError": "sedfiber.core.errors",
    "NumericalError": "sedfiber.core.errors",
    "Numerics": "sedfiber.scene.numerics",
    "Scene": "sedfiber.scene.scene",
    "SedfiberError": "sedfiber.core.errors",
    "SteadyState": "sedfiber.simulation.equilibria.steady",
    "Trajectory": "sedfiber.simulation.trajectory",
    "load_model": "sedfiber.reduced.forecaster",
    "read_scene": "sedfiber.scene.scene_file",
    "read_trajectory": "sedfiber.simulation.trajectory_file",
    "simulate": "sedfiber.simulation.run",
    "steady_state": "sedfiber.simulation.equilibria.steady",
    "write_trajectory": "sedfiber.simulation.trajectory_file",
}

__all__ = [*_EXPORTS, "__version__"]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return _version()
    if name not in _EXPORTS:
        raise AttributeError(f"module 'sedfiber' has no attribute {name!r}")
    return getattr(import_module(_EXPORTS[name]), name)


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version  # takes as long as half of NumPy

    try:
        return version("sedfiber")
    except PackageNotFoundError:  # run from a checkout that is not installed
        return "0+checkout"


def __dir__() -> list[str]:
    return sorted(__all__)
