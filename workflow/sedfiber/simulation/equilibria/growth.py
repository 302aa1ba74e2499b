"""Growth of a small disturbance along one mode of a steady state in the full equations of motion."""

from dataclasses import replace

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.physics.integrators import INTEGRATORS, Tolerances
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.spectrum import Mode

DISTURBANCE = 1e-4  # a: far above the integrator's error, and its square far below
FOLDS = 2.0  # e-foldings watched
_LONGEST = 2000.0  # a/U_s
_MOST_OF_OTHERS = 10.0  # e-foldings that round-off in the fastest growing mode may make meanwhile
_SAMPLES = 20
_METHOD, _TOLERANCE = "Radau", 1e-11


def measured_rate(scene: Scene, positions: Positions, mode: Mode, fastest: float = 0.0) -> float:
    """Rate in U_s/a at which the part along ``mode`` grows when ``positions`` (N, 3) are disturbed along it.

    The motion is integrated in volume; ``log |part|`` is fitted by a straight line over two
    e-foldings.  Other modes that round-off excites do not count: the adjoint mode leaves them out
    while they are small, so a state with a mode that grows at the rate ``fastest`` is watched for
    less long.  Raises NumericalError when the integration fails.
    """
    system = assemble(replace(scene, space="volume"))
    duration = min(FOLDS / max(abs(mode.rate.real), 1e-12), _LONGEST, _MOST_OF_OTHERS / max(fastest, 1e-12))
    integrator = INTEGRATORS[_METHOD](system, Tolerances(_TOLERANCE, _TOLERANCE))
    start = system.to_state(positions + DISTURBANCE * mode.right.real)
    states = integrator.states(start, duration / _SAMPLES)
    history = np.array([next(states) for _ in range(_SAMPLES + 1)])
    moved = system.to_shapes(history) - (positions - positions[system.centre])
    # a pair of complex modes: the displacement along the real part is half of each
    size = np.abs(mode.part(moved))
    t = np.linspace(0.0, duration, _SAMPLES + 1)
    return float(np.polyfit(t, np.log(size), 1)[0])
