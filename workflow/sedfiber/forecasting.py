"""A trained model as a user meets it: ℬ, θ₀ and times in, bead positions out.

The terminal shape and velocity at any ℬ come from the steady solver.
"""

from pathlib import Path

import numpy as np

from sedfiber._typing import History, Times
from sedfiber.learning.forecast import ForecastModel
from sedfiber.learning.model_files import load_forecast_model
from sedfiber.physics.settling import distance_to_terminal, settling_time
from sedfiber.physics.steady import SteadyState, steady_state
from sedfiber.scene import Scene
from sedfiber.trajectory import Trajectory

_FIRST_LOOK = 256  # samples forecast before the first look at whether the fiber has settled
_MOST_SAMPLES = 2**17


class Forecaster:
    """A loaded model; ``model.scales`` holds the range it was trained on."""

    def __init__(self, model: ForecastModel, hydrodynamics: str = "RPY"):
        self.model = model
        self.hydrodynamics = hydrodynamics

    def forecast(self, B: float, theta0: float, t: Times) -> History:
        """Positions (T, N, 3) at ascending times ``t`` (T,) from a straight start at the origin.

        Raises InputError for values that are not allowed, NumericalError when the
        integration fails.
        """
        scene = self._scene(B, theta0)
        return self._positions(scene, self._steady(scene), np.asarray(t, dtype=float))

    def settle(self, B: float, theta0: float, interval: float = 0.5, t_end: float | None = None) -> Trajectory:
        """Samples every ``interval`` until the forecast has settled, or until ``t_end``."""
        scene = self._scene(B, theta0)
        steady = self._steady(scene)
        count = _FIRST_LOOK if t_end is None else int(np.floor(t_end / interval * (1 + 1e-12))) + 1
        while True:
            t = interval * np.arange(count)
            positions = self._positions(scene, steady, t)
            shapes = positions - positions[:, scene.n_beads // 2, None]
            settled = settling_time(t, distance_to_terminal(shapes, steady.positions, scene.length))
            if t_end is not None or settled is not None or count >= _MOST_SAMPLES:
                break
            count *= 2
        keep = len(t) if t_end is not None or settled is None else int(np.searchsorted(t, settled)) + 1
        return Trajectory(t[:keep], positions[:keep], self._metadata(scene, interval, t_end, settled))

    def covers(self, B: float, theta0: float) -> bool:
        """Whether (ℬ, θ₀) lies within the range of the training data."""
        return self.model.scales.covers(B, theta0)

    def range_words(self) -> str:
        """The training range in words, for a warning."""
        scales = self.model.scales
        return f"B from {scales.B_min:g} to {scales.B_max:g} and |theta0| up to {scales.theta0_max:.4g}"

    def _scene(self, B: float, theta0: float) -> Scene:
        return Scene(B, theta0, self.model.scales.n_beads, hydrodynamics=self.hydrodynamics)

    def _steady(self, scene: Scene) -> SteadyState:
        return steady_state(scene.B, scene.n_beads, scene.hydrodynamics)

    def _positions(self, scene: Scene, steady: SteadyState, t: Times) -> History:
        start = np.zeros((scene.n_beads, 3))
        start[:, : scene.dim] = scene.start()
        return self.model.forecast(scene.B, start, steady.positions, steady.velocity, t)

    def _metadata(self, scene: Scene, interval: float, t_end: float | None, settled: float | None) -> dict:
        autoencoder = self.model.autoencoder
        return {
            "kind": "forecast",
            **scene.facts(),
            "model": {
                "variant": autoencoder.variant,
                "latent_dim": autoencoder.latent_dim,
                "trained_for": self.range_words(),
                "within_training_range": self.covers(scene.B, scene.start_angle),
            },
            "numerics": {"interval": interval, "t_end": t_end},
            "settling_time": settled,
        }


def load_model(folder: str | Path) -> Forecaster:
    """Load a forecast model, such as ``results/models/forecast``; raises InputError for anything else."""
    return Forecaster(load_forecast_model(folder))
