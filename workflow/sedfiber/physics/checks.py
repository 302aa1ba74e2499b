"""What every run is held to after it ends; a broken bound is an error, not a result."""

from dataclasses import asdict, dataclass

import numpy as np

from sedfiber._typing import State
from sedfiber.errors import NumericalError
from sedfiber.physics.gaps import smallest_gap
from sedfiber.physics.system import System

ENERGY_BALANCE = 1e-4  # of the energy lost; the default tolerances reach about 1e-6


@dataclass(frozen=True)
class Checks:
    """Measured on the samples; lengths in a, energies in 6πμaU_s·a.

    ``bond_strain_max`` is the largest ``|r/2 − 1|``, bounded by ``strain_bound = N/ℰ``
    (a tension of the fiber's whole weight); ``smallest_gap`` the least surface distance of
    beads that are not neighbours, bounded below by ``gap_bound``; ``energy_imbalance`` is
    the largest ``|U(0) − U(t) − ∫FᵀMF dt|``
    over the energy lost in the whole run; ``final_distance`` that to the terminal
    shape over L.
    """

    bond_strain_max: float
    strain_bound: float
    smallest_gap: float
    gap_bound: float
    energy_imbalance: float
    energy_bound: float
    final_distance: float

    def to_dict(self) -> dict:
        """Plain values for a file's metadata."""
        return asdict(self)

    def require(self) -> None:
        """Raise NumericalError naming the first bound that is broken."""
        self._bound("bond strain", self.bond_strain_max, self.strain_bound)
        self._bound("overlap of beads that are not neighbours", -self.smallest_gap, -self.gap_bound)
        self._bound("energy imbalance", self.energy_imbalance, self.energy_bound)

    @staticmethod
    def _bound(name: str, value: float, bound: float) -> None:
        if not value <= bound:
            raise NumericalError(
                f"check failed: {name} {value:.3g} is above its bound {bound:.3g}; "
                "try a smaller --rtol or another --integrator"
            )


def check(system: System, states: State, strain_bound: float, gap_bound: float, final_distance: float) -> Checks:
    """Measure a finished run from its states (T, N d + 1)."""
    shapes = system.to_shapes(states)[..., : system.shape[1]]
    bonds = np.linalg.norm(np.diff(shapes, axis=1), axis=2)
    return Checks(
        bond_strain_max=float(np.abs(0.5 * bonds - 1.0).max()),
        strain_bound=strain_bound,
        smallest_gap=min(smallest_gap(np.ascontiguousarray(x)) for x in shapes),
        gap_bound=gap_bound,
        energy_imbalance=_energy_imbalance(system, states),
        energy_bound=ENERGY_BALANCE,
        final_distance=final_distance,
    )


def _energy_imbalance(system: System, states: State) -> float:
    """Energy lost against work done, relative to the whole run's loss."""
    positions = system.to_positions(states)[..., : system.shape[1]]
    energy = np.array([system.energy(x) for x in positions])
    lost, work = energy[0] - energy, states[:, -1]
    return float(np.abs(lost - work).max() / np.abs(lost).max()) if len(states) > 1 else 0.0
