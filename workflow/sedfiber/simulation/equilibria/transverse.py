"""Growth of out-of-plane disturbances on planar states.

For a planar state the third coordinates ``z`` decouple from the other two: ``ż = A z`` with the
z–z block of the Jacobian in volume.  A shift of all beads changes nothing, so the centre bead's
row and column are taken out.  Where nothing tells one horizontal direction from another, a turn
about gravity is no disturbance either: its mode, ``z ∝ x``, is left out.
"""

from dataclasses import replace

import numpy as np

from sedfiber.core.array_types import Array, History, Matrix, Positions
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene


def transverse_rates(scene: Scene, shapes: History, positions: History) -> Array:
    """Leading out-of-plane rate (T,) in U_s/a at each sample of a planar run, given both ways (T, beads, 3)."""
    spatial = assemble(replace(scene, space="volume"))
    places = positions if spatial.needs_lab_frame else shapes
    turns = scene.flow is None and (scene.gravity is None or scene.gravity.direction[0] == 0.0)
    return np.array([leading_rate(transverse_matrix(spatial, x), x if turns else None) for x in places])


def transverse_matrix(spatial: System, x: Positions) -> Matrix:
    """``A`` relative to the centre bead, (beads − 1, beads − 1), at planar positions (beads, 3)."""
    n, centre = spatial.shape[0], spatial.centre
    block = spatial.velocity_jacobian(np.ascontiguousarray(x))[2::3, 2::3]
    relative = block - block[centre]
    keep = np.arange(n) != centre
    return relative[np.ix_(keep, keep)]


def leading_rate(matrix: Matrix, x: Positions | None) -> float:
    """Largest real part of an eigenvalue; without the mode nearest to a turn about gravity if ``x`` is given."""
    rates, modes = np.linalg.eig(matrix)
    turn = None if x is None else turn_about_gravity(x)
    if turn is None:
        return float(rates.real.max())
    likeness = np.abs(modes.conj().T @ turn)  # modes have length one
    return float(np.delete(rates, likeness.argmax()).real.max())


def turn_about_gravity(x: Positions) -> Array | None:
    """Out-of-plane displacement (beads − 1,) by a turn about the vertical, relative to the centre bead.

    None for beads exactly above each other: a turn leaves them where they are.
    """
    centre = len(x) // 2
    turn = np.delete(x[:, 0] - x[centre, 0], centre)
    return turn if turn.any() else None
