"""Positions of the beads at t = 0."""

import math

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.scene.fields import SceneFields
from sedfiber.scene.parts import Disturbance, Fiber
from sedfiber.scene.shape import REST


def start_positions(scene: SceneFields) -> Positions:
    """Every fiber at its place and angle, disturbed if the scene says so, shape (beads, d)."""
    fibers = [_fiber_start(scene, fiber) for fiber in scene.fibers or (Fiber(),)]
    x = np.vstack(fibers)
    return x if scene.disturbance is None else x + _displacement(scene.disturbance, x.shape, scene.seed)


def fiber_angle(scene: SceneFields, fiber: Fiber) -> float:
    """The fiber's inclination, or the scene's, or the seeded tilt where a straight start is exactly horizontal."""
    theta0 = scene.theta0 if fiber.theta0 is None else fiber.theta0
    if theta0 != 0.0 or scene.tilt == 0.0 or scene.shape is not None:
        return theta0
    return scene.tilt * float(np.random.default_rng(scene.seed).choice([1.0, -1.0]))


def _fiber_start(scene: SceneFields, fiber: Fiber) -> Positions:
    """One fiber, shape (N, d): turned about its centre bead, and put in its place."""
    angle = fiber_angle(scene, fiber)
    # exactly vertical means exactly: cos(π/2) is 6e-17 and would seed a buckling
    cos = 0.0 if abs(angle) == math.pi / 2 else math.cos(angle)
    sin = math.sin(angle)
    shape = _shape(scene)
    x = np.zeros((scene.n_beads, scene.dim))
    x[:, 0] = shape[:, 0] * cos - shape[:, 1] * sin
    x[:, 1] = shape[:, 0] * sin + shape[:, 1] * cos
    x[:, 2:] = shape[:, 2 : scene.dim]
    return x + np.array(fiber.place[: scene.dim])


def _shape(scene: SceneFields) -> Positions:
    """The shape before it is turned, centre bead at the origin, (N, 3)."""
    n = scene.n_beads
    if scene.shape == REST and scene.bending is not None and scene.bending.curvature != 0.0:
        from sedfiber.physics.curved_bending import rest_arc  # compiled: only for those who ask

        return rest_arc(n, scene.bending.curvature, 3)
    if scene.shape is None or scene.shape == REST:
        straight = np.zeros((n, 3))
        straight[:, 0] = 2.0 * (np.arange(n) - n // 2)
        return straight
    x = np.array(scene.shape)
    return x - x[n // 2]


def _displacement(disturbance: Disturbance, shape: tuple[int, int], seed: int) -> Positions:
    """Independent and uniform between ± amplitude, in the plane or out of it."""
    moves = np.random.default_rng(seed).uniform(-disturbance.amplitude, disturbance.amplitude, (shape[0], 3))
    moves[:, 2 if disturbance.direction == "in-plane" else slice(2)] = 0.0
    return moves[:, : shape[1]]
