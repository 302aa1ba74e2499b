"""Integrator, tolerances, sampling and end of a run."""

import math
from dataclasses import dataclass, replace

from sedfiber.core.errors import InputError
from sedfiber.core.validation import number_within, one_of, positive_number, yes_or_no
from sedfiber.physics.integrators import INTEGRATORS, STOCHASTIC, AboveWall, Integrator, StochasticMidpoint, Tolerances
from sedfiber.physics.protocols import BeadEquations
from sedfiber.physics.system import System
from sedfiber.scene.parts import Noise
from sedfiber.scene.scene import Scene

# See docs/cost.md: no other method of the table reaches 1e-6 L in less time. Against Radau at 1e-10 over a third of
# the study, at 1e-8 it is within 1.2e-6 L at all times.
DEFAULT_INTEGRATOR = "LSODA"
# of √(2/kTℰ), at which thermal kicks turn bonds over: measured, the scheme fails from 0.4 of it on,
# and the energy of bonds is 28 % high at 0.28, 1.5 % at 0.19
LONGEST_STEP = 0.2


@dataclass(frozen=True)
class Numerics:
    """Integrator, tolerances, sampling and end of a run.

    ``integrator`` follows from the scene where it is None: an implicit method, or with thermal
    noise the stochastic one.  ``rtol`` and ``atol`` (in a) bound the local error of each
    coordinate; ``interval`` is the sample spacing τ, ``t_end`` the end of the run (None: when
    the fiber has settled) and ``max_time`` the time by which a run without an end must have
    settled, all in a/U_s.  ``estimate_error`` repeats the run at tighter tolerances and records
    how far the two differ.  Raises InputError for any value that is not allowed.
    """

    integrator: str | None = None
    rtol: float = 1e-8
    atol: float = 1e-8
    interval: float = 0.5
    max_time: float = 1e5
    t_end: float | None = None
    estimate_error: bool = False

    def __post_init__(self) -> None:
        if self.integrator is not None:
            one_of("integrator", self.integrator, (*INTEGRATORS, STOCHASTIC))
        for key in ("rtol", "atol"):
            tolerance = number_within(key, getattr(self, key), 1e-13, 0.1, "a number from 1e-13 to 0.1")
            object.__setattr__(self, key, tolerance)
        for key in ("interval", "max_time"):
            object.__setattr__(self, key, positive_number(key, getattr(self, key)))
        if self.t_end is not None:
            object.__setattr__(self, "t_end", positive_number("t_end", self.t_end))
        object.__setattr__(self, "estimate_error", yes_or_no("estimate_error", self.estimate_error))

    def for_scene(self, scene: Scene) -> "Numerics":
        """The same with the scene's integrator where none was chosen; raises InputError for one that does not fit."""
        fitting = DEFAULT_INTEGRATOR if scene.noise is None else STOCHASTIC
        if scene.noise is not None and self.integrator not in (None, STOCHASTIC):
            raise InputError(
                f"integrator: {self.integrator} with noise is not allowed; it is deterministic, give {fitting}"
            )
        if scene.noise is None and self.integrator == STOCHASTIC:
            raise InputError(f"integrator: {STOCHASTIC} without noise is not allowed; give {', '.join(INTEGRATORS)}")
        if scene.noise is not None:
            _require_step(scene, scene.noise, self.interval)
        return replace(self, integrator=self.integrator or fitting)

    def integrator_for(self, system: BeadEquations, scene: Scene) -> Integrator:
        """The chosen integrator on ``system``."""
        tolerances = Tolerances(self.rtol, self.atol)
        integrator: Integrator
        if scene.noise is not None:
            assert isinstance(system, System)  # no symmetry is exact in noise
            integrator = StochasticMidpoint(system, tolerances, scene.noise.temperature, scene.noise.step, scene.seed)
        else:
            integrator = INTEGRATORS[self.integrator or DEFAULT_INTEGRATOR](system, tolerances)
        return integrator if scene.wall is None else AboveWall(integrator, system)


def _require_step(scene: Scene, noise: Noise, interval: float) -> None:
    """The step of a scene with noise must divide the interval, and be short enough for its bonds."""
    step, longest = noise.step, _longest_step(scene, noise)
    fitting = interval / math.ceil(interval / min(step, longest, interval))
    ratio = interval / step
    if abs(ratio - round(ratio)) > 1e-9 * ratio or round(ratio) < 1:
        raise InputError(
            f"noise.step: {step:g} does not divide the sampling interval {interval:g}; give {fitting:.12g}, "
            "or a smaller whole fraction of it"
        )
    if step > longest:
        raise InputError(
            f"noise.step: {step:g} is too long for bonds so warm and stiff; give {fitting:.12g}, "
            f"or a smaller whole fraction of the sampling interval {interval:g}"
        )


def _longest_step(scene: Scene, noise: Noise) -> float:
    """The step up to which the scheme keeps the bonds of a scene with noise; infinite where it has none."""
    if scene.stretching is None or scene.n_beads == 1:
        return math.inf
    modulus = scene.stretching.factor * max(scene.moduli)
    return LONGEST_STEP * (2.0 / (noise.temperature * modulus)) ** 0.5
