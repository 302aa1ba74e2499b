"""The system of exactly the parts that a scene lists."""

from sedfiber.physics.bending import Bending
from sedfiber.physics.free_draining import FreeDraining
from sedfiber.physics.gravity import Gravity
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.protocols import ConservativeForce, Flow, Force, Mobility
from sedfiber.physics.stretching import Stretching
from sedfiber.physics.system import System
from sedfiber.scene import parts
from sedfiber.scene.scene import Scene


def assemble(scene: Scene) -> System:
    """Conservative forces, other forces and flows of the scene, moved through its mobility.

    A part's module is imported where the part is made, so that a scene pays for its own parts alone.
    """
    forces: list[ConservativeForce] = []
    nonconservative: list[Force] = []
    flows: list[Flow] = []
    if scene.gravity is not None:
        forces.append(Gravity(scene.gravity.weight))
    forces += _elasticity(scene)
    if scene.contact is not None:
        forces += _contacts(scene, scene.contact)
    if scene.flow is not None:
        _add_flow(scene, scene.flow, flows, nonconservative)
    for own in scene.own:
        _add_own(own, forces, nonconservative, flows)
    return System(forces, _mobility(scene), scene.n_fibers * scene.n_beads, scene.dim, nonconservative, flows)


def _elasticity(scene: Scene) -> list[ConservativeForce]:
    """Springs and bending, fiber by fiber."""
    elastic: list[ConservativeForce] = []
    for k, modulus in enumerate(scene.moduli):
        beads = (k * scene.n_beads, (k + 1) * scene.n_beads)
        if scene.stretching is not None:
            elastic.append(Stretching(scene.stretching.factor * modulus, *beads))
        if scene.bending is not None:
            elastic.append(_bending(modulus, scene.bending.curvature, beads))
    return elastic


def _bending(modulus: float, curvature: float, beads: tuple[int, int]) -> ConservativeForce:
    if curvature == 0.0:
        return Bending(modulus, *beads)
    from sedfiber.physics.curved_bending import CurvedBending

    return CurvedBending(modulus, curvature, *beads)


def _contacts(scene: Scene, part: parts.Contact) -> list[ConservativeForce]:
    from sedfiber.physics.contact import Contact

    law = (part.strength, part.reach)
    if scene.wall is None:
        return [Contact(*law, scene.n_beads)]
    from sedfiber.physics.wall_contact import WallContact

    return [Contact(*law, scene.n_beads), WallContact(*law, scene.wall.point, scene.wall.normal)]


def _add_flow(scene: Scene, part: parts.Flow, flows: list[Flow], nonconservative: list[Force]) -> None:
    """The flow, the couple it exerts on beads that turn with their fiber, and the flow that these make."""
    from sedfiber.physics.couple_flow import CoupleFlow
    from sedfiber.physics.flow_couple import FlowCouple
    from sedfiber.physics.linear_flow import LinearFlow
    from sedfiber.physics.parabolic_flow import ParabolicFlow

    flow = LinearFlow(part.matrix) if part.parabola is None else ParabolicFlow(*part.parabola)
    flows.append(flow)
    if part.couple:
        nonconservative.append(FlowCouple(flow, scene.n_beads))
    if part.couple and scene.hydrodynamics != "none":
        flows.append(CoupleFlow(flow, scene.n_beads))


def _add_own(own: parts.Own, forces: list[ConservativeForce], nonconservative: list[Force], flows: list[Flow]) -> None:
    from sedfiber.scene.own_effect import OwnFlow, load_own

    effect = load_own(own)
    if isinstance(effect, OwnFlow):
        flows.append(effect)
    elif hasattr(effect, "energy"):
        forces.append(effect)
    else:
        nonconservative.append(effect)


def _mobility(scene: Scene) -> Mobility:
    if scene.hydrodynamics == "none":
        return FreeDraining()
    free = PairMobility(scene.hydrodynamics, scene.dim)
    if scene.wall is None:
        return free
    from sedfiber.physics.near_wall import NearWall
    from sedfiber.physics.wall import WallCorrection

    return NearWall(free, WallCorrection(scene.wall.point, scene.wall.normal), scene.contact is not None)
