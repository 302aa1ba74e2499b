"""From a scene to the system of exactly the effects it lists."""

from sedfiber.physics.bending import Bending
from sedfiber.physics.gravity import Gravity
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.stretching import Stretching
from sedfiber.physics.system import System
from sedfiber.scene import Scene


def assemble(scene: Scene) -> System:
    """Gravity, stretching and bending, moved through the scene's mobility."""
    forces = (Gravity(), Stretching(scene.modulus), Bending(scene.modulus))
    return System(forces, PairMobility(scene.hydrodynamics, scene.dim), scene.n_beads, scene.dim)
