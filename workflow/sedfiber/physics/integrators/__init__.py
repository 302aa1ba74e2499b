"""Integrators by name; each yields the state at every multiple of a sampling interval."""

from sedfiber.physics.integrators.above_wall import AboveWall
from sedfiber.physics.integrators.base import Counters, Integrator, Tolerances
from sedfiber.physics.integrators.dopri5 import Dopri5
from sedfiber.physics.integrators.implicit import BDF, Radau
from sedfiber.physics.integrators.lsoda import LSODA
from sedfiber.physics.integrators.stochastic import StochasticMidpoint

# Those of deterministic scenes; noise has the stochastic one.
INTEGRATORS: dict[str, type[Integrator]] = {
    "BDF": BDF,
    "Radau": Radau,
    "LSODA": LSODA,
    "dopri5": Dopri5,
}
STOCHASTIC = StochasticMidpoint.name

__all__ = ["INTEGRATORS", "STOCHASTIC", "AboveWall", "Counters", "Integrator", "StochasticMidpoint", "Tolerances"]
