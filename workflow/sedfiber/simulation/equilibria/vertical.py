"""The straight fiber that falls along its own axis: a steady state, unstable at every ℬ.

Its bonds are stretched above and compressed below the centre.  All transverse directions are
alike, and a sideways displacement ``δ`` relative to the centre bead obeys ``δ̇ = A δ``.
"""

from dataclasses import replace

import numpy as np

from sedfiber.core.array_types import Array, Positions
from sedfiber.core.errors import NumericalError
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import SteadyState
from sedfiber.simulation.equilibria.steady_curve import TOLERANCE
from sedfiber.simulation.equilibria.transverse import transverse_matrix

_MAX_NEWTON = 30
_LAST_MOVE = 1e-9  # a: the last Newton step


def vertical_shape(scene: Scene) -> Positions:
    """Positions (N, 3) relative to the centre bead of the straight vertical fiber in steady fall.

    Raises NumericalError when Newton on the distances along the fiber does not converge.
    """
    n, centre = scene.n_beads, scene.n_beads // 2
    system = assemble(replace(scene, space="volume"))
    noise = np.finfo(float).eps * n * scene.modulus
    keep = np.arange(n) != centre
    x = np.zeros((n, 3))
    x[:, 1] = 2.0 * (np.arange(n) - centre)
    for _ in range(_MAX_NEWTON):
        u = system.velocity(x)[:, 1]
        jac = system.velocity_jacobian(x)[1::3, 1::3]
        step = np.linalg.solve((jac - jac[centre])[np.ix_(keep, keep)], (u - u[centre])[keep])
        x[keep, 1] -= step
        if np.abs(u - u[centre]).max() < TOLERANCE + noise and np.abs(step).max() < _LAST_MOVE:
            return x
    raise NumericalError(f"no vertical fall found at B={scene.B:g}; try a smaller B")


def vertical_state(scene: Scene) -> SteadyState:
    """The straight vertical fiber in steady fall, with its velocity and residual; raises as ``vertical_shape``."""
    x = vertical_shape(scene)
    system = assemble(replace(scene, space="volume"))
    velocity = system.velocity(x)
    fall = velocity[system.centre]
    return SteadyState(scene.B, x, fall, float(np.abs(velocity - fall).max()), "vertical")


def vertical_rates(scene: Scene) -> Array:
    """Growth rates of sideways disturbances, (N − 1,) complex in U_s/a, the fastest growing first."""
    x = vertical_shape(scene)
    rates = np.linalg.eigvals(transverse_matrix(assemble(replace(scene, space="volume")), x))
    return rates[np.argsort(-rates.real, kind="stable")]
