"""From a scene to the system of exactly the effects it lists."""

from sedfiber.physics.bending import Bending
from sedfiber.physics.gravity import Gravity
from sedfiber.physics.rpy import RotnePragerYamakawa
from sedfiber.physics.stretching import Stretching
from sedfiber.physics.system import System
from sedfiber.scene import Scene


def assemble(scene: Scene) -> System:
    """Gravity, stretching and bending, moved through the scene's mobility."""
    forces = (Gravity(), Stretching(scene.modulus), Bending(scene.modulus))
    mobility = RotnePragerYamakawa(overlap=scene.hydrodynamics == "RPY-overlap")
    return System(forces, mobility, scene.n_beads, scene.dim)
