"""Bounds on what a scene's parts can do; a sound run cannot break them."""

import numpy as np

from sedfiber.scene.parts import Flow
from sedfiber.scene.scene import Scene

_UNLOADED = 0.01  # where nothing pulls, tolerances do
_CLEARANCE = 2.0  # over the estimate, for what the estimate leaves out


def strain_bound(scene: Scene) -> float | None:
    """Largest bond strain that the scene's loads can cause; None where nobody can know.

    The weight alone stretches a bond by its tension over ℰ, at most ``N/ℰ``.  A flow pulls a bead
    with its rate times its distance; contact pushes with its strength; noise adds the thermal
    strain ``√(kT/2ℰ)``, six times it in 1e9 draws; a start may be stretched already.
    """
    if scene.own or scene.stretching is None:
        return None
    n = scene.n_beads
    modulus = scene.stretching.factor * min(scene.moduli)
    load = n * (scene.gravity.strength if scene.gravity else 0.0)
    bound = (load + _CLEARANCE * _other_loads(scene)) / modulus
    if scene.noise is not None:
        bound += 6.0 * (scene.noise.temperature / (2.0 * modulus)) ** 0.5
    if scene.shape is not None or scene.disturbance is not None:
        bonds = np.diff(scene.start().reshape(-1, n, scene.dim), axis=1)
        bound += float(np.abs(0.5 * np.linalg.norm(bonds, axis=2) - 1.0).max(initial=0.0))
    return bound if scene.gravity is not None else max(bound, _UNLOADED)


def _other_loads(scene: Scene) -> float:
    n, load = scene.n_beads, 0.0
    if scene.flow is not None:
        load += _steepest(scene, scene.flow) * n * n
    if scene.contact is not None:
        load += 2.0 * scene.contact.strength
    if scene.bending is not None and scene.shape is not None:
        load += max(scene.moduli) / 8.0 * np.pi  # a bend straightens with at most this force
    return load + (n if scene.n_fibers > 1 and scene.gravity else 0.0)


def _steepest(scene: Scene, flow: Flow) -> float:
    """A rate of the flow that is not exceeded near the fiber."""
    if flow.parabola is not None:
        peak, half_width = flow.parabola
        reach = scene.n_beads + float(np.abs(scene.start()[:, 1]).max())
        return 4.0 * abs(peak) * reach / half_width**2
    return float(np.linalg.norm(flow.matrix, 2)) if flow.rate is None else abs(flow.rate)
