"""The test trajectories as questions: a start, sample times, and an answer to measure others against."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import History
from sedfiber.reduced.dataset import SettlingFall
from sedfiber.reduced.measures import forecast_error
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.study.costs.fall_problem import FallProblem

REFERENCE = Numerics("BDF", 1e-9, 1e-9)


@dataclass(frozen=True)
class Query:
    """One test trajectory: ``fall`` to its settling time, and what it should be, ``truth`` (T, N, 3)."""

    trajectory: SettlingFall
    fall: FallProblem
    truth: History

    @property
    def B(self) -> float:
        """Elasto-gravitational number."""
        return self.trajectory.B

    def error(self, positions: History) -> float:
        """Largest root-mean-square bead distance over L at any sample; ``positions`` (T, N, 2 or 3)."""
        return largest_distance(self._whole(positions), self.truth, self.fall.scene.length)

    def E(self, positions: History) -> float:
        """Largest E(t), see `learning.measures`."""
        return float(forecast_error(self.truth, self._whole(positions)).total.max())

    def _whole(self, positions: History) -> History:
        missing = 3 - positions.shape[-1]
        return np.pad(np.asarray(positions, dtype=float), ((0, 0), (0, 0), (0, missing)))


def queries(trajectories: Iterable[SettlingFall], hydrodynamics: str = Scene.hydrodynamics) -> list[Query]:
    """Each trajectory integrated again by BDF at 1e-9, to measure simulations against."""
    falls = [(one, _fall(one, hydrodynamics)) for one in trajectories]
    return [Query(one, fall, fall.by_numerics(REFERENCE).positions) for one, fall in falls]


def stored_queries(trajectories: Iterable[SettlingFall], hydrodynamics: str = Scene.hydrodynamics) -> list[Query]:
    """Each trajectory as it is stored, which is right to 1e-6 L: enough for forecasts."""
    return [Query(one, _fall(one, hydrodynamics), one.positions) for one in trajectories]


def _fall(one: SettlingFall, hydrodynamics: str) -> FallProblem:
    scene = Scene(one.B, one.theta0, len(one.terminal), hydrodynamics=hydrodynamics)
    return FallProblem(scene, len(one.t), float(one.t[1]))
