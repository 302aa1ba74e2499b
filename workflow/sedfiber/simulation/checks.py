"""Checks of every run after its end; a broken bound is an error, not a result."""

from dataclasses import asdict, dataclass

import numpy as np

from sedfiber.core.array_types import Array, History
from sedfiber.core.errors import NumericalError
from sedfiber.physics.definiteness import CLOSE, OVERLAP_REMEDY, least_eigenvalue
from sedfiber.physics.gaps import closest_distance, smallest_gap
from sedfiber.physics.mirror import MirrorSymmetric
from sedfiber.physics.system import System
from sedfiber.scene.parts import Wall
from sedfiber.scene.scene import Scene
from sedfiber.simulation.bounds import strain_bound
from sedfiber.simulation.recorded_run import Run

_LOOKED_AT = 32  # samples of closest approach whose mobility is examined
ENERGY_BALANCE = 1e-4  # of the energy lost; the default tolerances reach about 1e-6


@dataclass(frozen=True)
class Checks:
    """Measured on the samples; lengths in a, energies in 6πμaU_s·a; None where it means nothing.

    ``bond_strain_max`` is the largest ``|r/2 − 1|``; ``smallest_gap`` the least surface distance
    of beads that are not neighbours; ``wall_gap`` that of a bead and the wall; ``least_mobility`` the
    smallest eigenvalue of a mobility that can lose it, where beads overlap; ``energy_imbalance``
    the largest ``|U(0) − U(t) − ∫F·ẋ dt|`` over all energy gained or lost in the run;
    ``final_distance`` that to the terminal shape over L.  The bounds are those of
    ``physics.bounds``, and 1e-4 on the energy.
    """

    bond_strain_max: float | None
    strain_bound: float | None
    smallest_gap: float | None
    energy_imbalance: float | None
    energy_bound: float | None
    final_distance: float | None
    wall_gap: float | None = None
    least_mobility: float | None = None

    def to_dict(self) -> dict:
        """Plain values for a file's metadata."""
        return asdict(self)

    def require(self, own_effects: bool = False) -> None:
        """Raise NumericalError naming the first bound that is broken; effects of the user's may be to blame."""
        noisy = self.energy_bound is None
        accuracy = "try a smaller noise.step" if noisy else "try a smaller --rtol or another --integrator"
        self._bound("bond strain", self.bond_strain_max, self.strain_bound, accuracy)
        if self.least_mobility is not None and not self.least_mobility > 0.0:
            raise NumericalError(
                f"check failed: beads overlap until the mobility is not positive definite (smallest eigenvalue "
                f"{self.least_mobility:.3g}); {OVERLAP_REMEDY}"
            )
        doubt = ", or is an energy(x) of yours not that of its force(x)?" if own_effects else ""
        self._bound("energy imbalance", self.energy_imbalance, self.energy_bound, accuracy + doubt)

    @staticmethod
    def _bound(name: str, value: float | None, bound: float | None, advice: str) -> None:
        if value is not None and bound is not None and not value <= bound:
            raise NumericalError(f"check failed: {name} {value:.3g} is above its bound {bound:.3g}; {advice}")


def check(scene: Scene, system: System | MirrorSymmetric, run: Run, final_distance: float | None) -> Checks:
    """Measure a finished run of ``system``."""
    positions = run.positions[..., : scene.dim]
    shapes = np.ascontiguousarray(run.shapes[..., : scene.dim])
    balanced = scene.noise is None
    return Checks(
        bond_strain_max=largest_strain(shapes, scene.n_beads),
        strain_bound=strain_bound(scene),
        smallest_gap=_smallest_gap(shapes, scene.n_beads),
        energy_imbalance=_energy_imbalance(system, scene, positions, run.states[:, -1]) if balanced else None,
        energy_bound=ENERGY_BALANCE if balanced else None,
        final_distance=final_distance,
        wall_gap=None if scene.wall is None else _wall_gap(scene.wall, positions),
        least_mobility=_least_mobility(system, positions) if scene.hydrodynamics in ("RPY", "Oseen") else None,
    )


def largest_strain(shapes: History, n_beads: int) -> float | None:
    """``|r/2 − 1|`` over all bonds of shapes (T, beads, d); None where there is no bond."""
    if n_beads == 1:
        return None
    bonds = np.diff(shapes.reshape(len(shapes), -1, n_beads, shapes.shape[-1]), axis=2)
    return float(np.abs(0.5 * np.linalg.norm(bonds, axis=3) - 1.0).max())


def _smallest_gap(shapes: History, n_beads: int) -> float | None:
    """The smallest gap between beads that are no neighbours; None where there are none."""
    gap = min(smallest_gap(x, n_beads) for x in shapes)
    return None if np.isinf(gap) else gap


def _least_mobility(system: System | MirrorSymmetric, positions: History) -> float | None:
    """Over the samples where beads come closest; None where none come close."""
    nearest = np.array([closest_distance(np.ascontiguousarray(x)) for x in positions])
    close = np.argsort(nearest, kind="stable")[:_LOOKED_AT]
    found = [least_eigenvalue(system.mobility, positions[k]) for k in close if nearest[k] < CLOSE]
    return min(found, default=None)


def _wall_gap(wall: Wall, positions: History) -> float:
    heights = (positions - np.array(wall.point)) @ np.array(wall.normal)
    return float(heights.min()) - 1.0


def _energy_imbalance(system: System | MirrorSymmetric, scene: Scene, positions: History, work: Array) -> float:
    """Energy lost against work done, relative to all the energy that changed hands in the run.

    Where next to none does (a rigid fiber tumbling), relative to that of the fiber bent through
    one radian, ``ℰ/16N``.
    """
    energy = np.array([system.energy(x) for x in positions])
    turnover = np.abs(np.diff(energy)).sum()
    bent = max(scene.moduli) / (16.0 * scene.n_beads)
    return float(np.abs(energy[0] - energy - work).max() / max(turnover, bent))
