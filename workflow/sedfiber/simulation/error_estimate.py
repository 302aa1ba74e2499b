"""Error estimate of a run: the same run at tighter tolerances, compared sample by sample.

A cheap estimate: one more run of half again the cost, the same method and no other checks.  It sees the
error of the steps; that of the model (beads, mobility) is another matter.
"""

from dataclasses import replace
from itertools import islice

import numpy as np

from sedfiber.core.errors import NumericalError
from sedfiber.physics.mirror import MirrorSymmetric
from sedfiber.physics.system import System
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.recorded_run import Run

TIGHTER = 1e-2  # of the run's tolerances
LEAST = 1e-12  # tolerance below which round-off rules
LOOSE = 1e-5  # tolerance above which a run is not believed without an estimate
PROPORTION = 5.0  # of the tolerance, over L: half of what is promised, for the estimate is one


def needs_estimate(scene: Scene, numerics: Numerics) -> bool:
    """Whether to estimate: with ``estimate_error``, or at loose tolerances; noise follows no tolerance."""
    return scene.noise is None and (numerics.estimate_error or _loosest(numerics) > LOOSE)


def estimate_error(scene: Scene, numerics: Numerics, system: System | MirrorSymmetric, run: Run) -> float:
    """Largest root-mean-square bead distance over L from the same run at a hundredth of the tolerances.

    ``run`` is one of ``system``.  Raises NumericalError when a run at loose
    tolerances is further off than five times them: its steps fit, but where they lead does not.
    """
    tight = replace(numerics, rtol=_tighter(numerics.rtol), atol=_tighter(numerics.atol))
    integrator = tight.integrator_for(system, scene)
    again = np.array(list(islice(integrator.states(system.to_state(scene.start()), tight.interval), len(run.t))))
    error = largest_distance(system.to_positions(again), run.positions, scene.length)
    loosest = _loosest(numerics)
    if loosest > LOOSE and not error <= PROPORTION * loosest:
        raise NumericalError(
            f"check failed: the run differs by {error:.3g} L from one at tighter tolerances, "
            f"more than {PROPORTION:g} times its own ({loosest:g}); try a smaller --rtol"
        )
    return error


def _loosest(numerics: Numerics) -> float:
    return max(numerics.rtol, numerics.atol)


def _tighter(tolerance: float) -> float:
    return min(tolerance, max(TIGHTER * tolerance, LEAST))
