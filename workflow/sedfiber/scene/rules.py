"""Which parts of a scene go together; each rule raises an error that names the key."""

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.core.errors import InputError
from sedfiber.physics.definiteness import CLOSE, closest_pair, least_eigenvalue
from sedfiber.scene.fields import SceneFields
from sedfiber.scene.parts import Flow, Wall
from sedfiber.scene.start import start_positions

_TOUCHING = 2.0 * (1.0 - 1e-9)
_THROUGH = 1.5  # a: where two straight rows of touching beads cross, one pair is nearer than √2
_UNSTRAINED = 0.25  # a start whose every bond is strained by more, and all to one side, has another unit
_NO_SLIP = 1e-6  # of the flow's speed as far away as the wall: what a normal written with few digits leaves on it


def require_sense(scene: SceneFields) -> None:
    """Raise InputError for the first combination that makes no sense."""
    if scene.space == "plane":
        _require_flat(scene)
    if scene.wall is not None and scene.hydrodynamics not in ("RPY", "RPY-overlap"):
        raise InputError(
            f"hydrodynamics: {scene.hydrodynamics} near a wall is not allowed; its correction is one to RPY, "
            "give RPY or RPY-overlap"
        )
    if scene.space == "volume" and scene.shape is None and scene.bending and scene.bending.curvature:
        raise InputError(
            "bending.curvature: a straight start in volume has no direction to bend to; "
            "give shape: rest, another shape, or space: plane"
        )
    if scene.wall is not None:
        _require_above_wall(scene.wall, start_positions(scene))
        if scene.flow is not None:
            _require_no_slip(scene.wall, scene.flow)
    if scene.fibers or scene.shape is not None or scene.disturbance is not None:
        _require_apart(scene, start_positions(scene))
    if scene.contact is not None and scene.n_fibers > 1:
        _require_not_crossed(scene, start_positions(scene))
    if scene.hydrodynamics == "Oseen":
        _require_positive(scene, start_positions(scene))


def is_symmetric(scene: SceneFields) -> bool:
    """Whether the start is its own image by ``x → −x`` with the beads reversed, to the last bit, and nothing tells
    left from right.
    """
    one_sided = scene.flow, scene.noise, *scene.own
    if any(one_sided) or scene.n_fibers > 1 or (scene.gravity is not None and scene.gravity.direction[0] != 0.0):
        return False
    if scene.wall is not None and scene.wall.normal[0] != 0.0:
        return False
    x = start_positions(scene)
    x = x - x[scene.n_beads // 2]
    return np.array_equal(x[::-1, 0], -x[:, 0]) and np.array_equal(x[::-1, 1:], x[:, 1:])


def _require_flat(scene: SceneFields) -> None:
    """A planar scene may hold nothing that moves a fiber out of z = 0."""
    if scene.wall is not None:
        raise InputError("wall: cuts the plane of a planar scene; give space: volume")
    if scene.gravity is not None and scene.gravity.direction[2] != 0.0:
        raise InputError("gravity.direction: points out of the plane of a planar scene; give space: volume")
    if scene.flow is not None and scene.flow.gradient is not None:
        g = np.array(scene.flow.gradient)
        if g[2].any() or g[:, 2].any():
            raise InputError("flow.gradient: leaves the plane of a planar scene; give space: volume")
    if any(fiber.place[2] != 0.0 for fiber in scene.fibers):
        raise InputError("fibers.place: out of the plane z = 0 of a planar scene; give space: volume")
    if scene.disturbance is not None and scene.disturbance.direction == "out-of-plane":
        raise InputError("disturbance.direction: out-of-plane in a planar scene is not allowed; give space: volume")


def _require_above_wall(wall: Wall, x: Positions) -> None:
    heights = (x - np.array(wall.point)) @ np.array(wall.normal)
    lowest = int(heights.argmin())
    if heights[lowest] < 1.0:
        raise InputError(
            f"wall: bead {lowest} starts {heights[lowest]:.4g} a above it, less than its radius; "
            "move wall.point or turn wall.normal to the fiber's side"
        )


def _require_no_slip(wall: Wall, flow: Flow) -> None:
    """A flow through or along the wall contradicts it."""
    point, normal = np.array(wall.point), np.array(wall.normal)
    along = np.linalg.svd(normal[None])[2][1:]  # two directions in the wall
    on_wall = point + np.array([a * along[0] + b * along[1] for a in (-1, 0, 1) for b in (-1, 0, 1)])
    slip = np.abs(_flow_velocity(flow, on_wall)).max()  # at most quadratic: zero there means all over the wall
    usual = np.abs(_flow_velocity(flow, (1.0 + np.abs(point).max()) * np.eye(3))).max()
    if slip > _NO_SLIP * usual:
        raise InputError(
            f"flow: is {slip:.3g} U_s at wall.point or beside it, on a wall without slip; give a flow that is zero "
            "all over the wall, such as a shear over wall.point [0, 0, 0], with fibers.place to put the fiber above"
        )


def _flow_velocity(flow: Flow, x: Positions) -> Positions:
    """Velocity of the fluid, and not of a bead in it, at points (P, 3)."""
    if flow.parabola is None:
        return x @ np.array(flow.matrix).T
    peak, half_width = flow.parabola
    return np.outer(peak * (1.0 - (x[:, 1] / half_width) ** 2), [1.0, 0.0, 0.0])


def _require_apart(scene: SceneFields, x: Positions) -> None:
    """No two beads in one place, and none so close that the mobility loses its meaning."""
    i, j, r = closest_pair(x)
    if r == 0.0:
        raise InputError(f"start: beads {i} and {j} are in one place; move one of them")
    if scene.shape not in (None, "rest") and scene.stretching is not None and scene.n_beads > 1:
        _require_bonds_of_touching_beads(scene, x)
    if scene.hydrodynamics == "Oseen" and r < _TOUCHING:
        raise InputError(
            f"hydrodynamics: Oseen with beads that overlap ({i} and {j} are {r:.4g} a apart) is not allowed; "
            "give RPY-overlap"
        )
    if scene.hydrodynamics == "RPY" and r < CLOSE:
        least = _least_eigenvalue(scene, x)
        if least <= 0.0:
            raise InputError(
                f"hydrodynamics: plain RPY is not positive definite for beads {i} and {j}, {r:.4g} a apart "
                f"(smallest eigenvalue {least:.2g}); give RPY-overlap"
            )


def _require_bonds_of_touching_beads(scene: SceneFields, x: Positions) -> None:
    """A shape in another unit would jump to its length at the start."""
    bonds = np.linalg.norm(np.diff(x.reshape(scene.n_fibers, scene.n_beads, -1), axis=1), axis=-1)
    strain = 0.5 * bonds - 1.0
    if strain.min() > _UNSTRAINED or strain.max() < -_UNSTRAINED:
        raise InputError(
            f"shape: bonds are {bonds.min():.3g} to {bonds.max():.3g} a long, and 2 a at rest; "
            "give positions in bead radii a, or stretching: none"
        )


def _require_not_crossed(scene: SceneFields, x: Positions) -> None:
    """Contact keeps fibers apart that start apart; those that start crossed it would hold together for good."""
    fiber = np.arange(len(x)) // scene.n_beads
    distance = np.where(fiber[:, None] == fiber, np.inf, np.linalg.norm(x[:, None] - x, axis=-1))
    i, j = divmod(int(distance.argmin()), len(x))
    if distance[i, j] < _THROUGH:
        raise InputError(
            f"contact: beads {i} and {j} are {distance[i, j]:.3g} a apart at the start, so near that their fibers may "
            "be through each other, and contact would keep them so; move fibers.place, or change the shape"
        )


def _require_positive(scene: SceneFields, x: Positions) -> None:
    """Oseen's tensor for many touching beads moves some of them against the pull."""
    least = _least_eigenvalue(scene, x)
    if least <= 0.0:
        raise InputError(
            f"hydrodynamics: Oseen is not positive definite for these {len(x)} beads (smallest eigenvalue "
            f"{least:.2g}): it moves some against the pull; give RPY"
        )


def _least_eigenvalue(scene: SceneFields, x: Positions) -> float:
    from sedfiber.physics.pair_mobility import PairMobility  # compiled: only for those who ask

    return least_eigenvalue(PairMobility(scene.hydrodynamics, scene.dim), x)
