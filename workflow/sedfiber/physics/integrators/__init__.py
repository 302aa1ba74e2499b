"""Integrators by name; each yields the state at every multiple of a sampling interval."""

from sedfiber.physics.integrators.above_wall import AboveWall
from sedfiber.physics.integrators.base import Counters, March, Tolerances
from sedfiber.physics.integrators.dopri5 import Dopri5
from sedfiber.physics.integrators.implicit import BDFMarch, RadauMarch
from sedfiber.physics.integrators.lsoda import LSODAMarch
from sedfiber.physics.integrators.stochastic import StochasticMidpoint

# Those of deterministic scenes; noise has the stochastic one.
INTEGRATORS: dict[str, type[March]] = {
    "BDF": BDFMarch,
    "Radau": RadauMarch,
    "LSODA": LSODAMarch,
    "dopri5": Dopri5,
}
STOCHASTIC = StochasticMidpoint.name

__all__ = ["INTEGRATORS", "STOCHASTIC", "AboveWall", "Counters", "March", "StochasticMidpoint", "Tolerances"]
