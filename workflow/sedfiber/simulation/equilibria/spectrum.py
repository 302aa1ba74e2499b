"""The spectrum of the linearised dynamics at a steady planar state, in the plane and out of it.

Relative to the centre bead a small displacement ``δ`` of the beads obeys ``δ̇ = A δ``.  On a planar
state the coordinates in the plane and the one across it do not mix.  A translation is not seen
relative to the centre bead, and a turn about gravity, ``δ_z ∝ x``, is neutral; both are left out.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import eig

from sedfiber.core.array_types import Array, Matrix, Positions
from sedfiber.physics.mirror import whole
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.transverse import leading_rate, transverse_matrix, turn_about_gravity


@dataclass(frozen=True)
class Mode:
    """One eigenmode: complex ``rate`` in U_s/a, complex displacement ``right`` (N, 3) of largest size 1 a.

    ``left`` (N, 3) is the adjoint mode, scaled so that ``Σ left* · right = 1``: its product with a
    small displacement is the part of it along this mode.
    """

    rate: complex
    right: Array
    left: Array

    @property
    def symmetric(self) -> bool:
        """Whether the displaced fiber is still its own left–right mirror image."""
        image = whole(self.right[len(self.right) // 2 :])
        return bool(np.abs(self.right - image).max() < 1e-3)

    def part(self, displacement: Array) -> Array:
        """Complex amplitude (...) of this mode in displacements (..., N, 3) relative to the centre bead."""
        return np.einsum("ik,...ik->...", self.left.conj(), displacement)


@dataclass(frozen=True)
class Spectrum:
    """All modes but the neutral ones of a planar steady state, the fastest growing first.

    ``round_off`` is the size in U_s/a below which a rate means nothing: no disturbance is taken to
    grow because of it.
    """

    in_plane: list[Mode]
    out_of_plane: list[Mode]
    round_off: float

    @property
    def in_plane_rate(self) -> float:
        """Largest growth rate of a disturbance within the plane, in U_s/a."""
        return self.in_plane[0].rate.real

    @property
    def out_of_plane_rate(self) -> float:
        """Largest growth rate of a disturbance across the plane, in U_s/a."""
        return self.out_of_plane[0].rate.real

    @property
    def stable_in_plane(self) -> bool:
        """Whether every disturbance within the plane decays."""
        return self.in_plane_rate < self.round_off

    @property
    def stable_in_volume(self) -> bool:
        """Whether every disturbance but a turn about gravity decays."""
        return self.stable_in_plane and self.out_of_plane_rate < self.round_off


def spectrum(scene: Scene, positions: Positions) -> Spectrum:
    """Modes of a scene's steady planar state at ``positions`` (N, 3) relative to the centre bead."""
    spatial = assemble(replace(scene, space="volume"))
    x = np.ascontiguousarray(positions)
    across = _modes(transverse_matrix(spatial, x), [2], spatial, turn_about_gravity(x))
    return Spectrum(_modes(_in_plane_matrix(spatial, x), [0, 1], spatial), across, round_off(scene))


def round_off(scene: Scene) -> float:
    """Round-off in the rates of a scene, in U_s/a; the stiffest rate is of the size of the stiffest modulus."""
    return float(np.finfo(float).eps * scene.stiffening * scene.modulus)


def leaving_rate(scene: Scene, positions: Positions, symmetric: bool, flat: bool) -> float:
    """Largest growth rate in U_s/a among the disturbances that a run can have, without the modes themselves.

    A run that is exactly ``symmetric`` stays so, and one that is ``flat`` stays in its plane.
    """
    spatial = assemble(replace(scene, space="volume"))
    x = np.ascontiguousarray(positions)
    matrix = _in_plane_matrix(spatial, x)
    if symmetric:
        half = (len(x) // 2) * 2  # unknowns of the beads before the centre bead, whose images are those after it
        images = matrix[half:, :half].reshape(half, -1, 2)[:, ::-1] * np.array([-1.0, 1.0])
        matrix = matrix[half:, half:] + images.reshape(half, half)
    fastest = float(np.linalg.eigvals(matrix).real.max())
    return fastest if flat else max(fastest, leading_rate(transverse_matrix(spatial, x), x))


def _in_plane_matrix(spatial: System, x: Positions) -> Matrix:
    """``A`` in the plane relative to the centre bead, (2 (N − 1), 2 (N − 1))."""
    n = len(x)
    jac = spatial.velocity_jacobian(x).reshape(n, 3, n, 3)[:, :2, :, :2]
    relative = np.delete(jac - jac[spatial.centre], spatial.centre, axis=0)
    return np.delete(relative, spatial.centre, axis=2).reshape(2 * (n - 1), 2 * (n - 1))


def _modes(matrix: Matrix, axes: list[int], spatial: System, neutral: Array | None = None) -> list[Mode]:
    """Modes of ``matrix`` by falling growth rate, without the one most like ``neutral``."""
    rates, left, right = eig(matrix, left=True, right=True)
    order = np.argsort(-rates.real, kind="stable")
    if neutral is not None:
        likeness = np.abs(right.conj().T @ neutral)  # modes have length one
        order = order[order != likeness.argmax()]
    return [_mode(rates[k], right[:, k], left[:, k], axes, spatial) for k in order]


def _mode(rate: complex, right: Array, left: Array, axes: list[int], spatial: System) -> Mode:
    """Eigenvectors of the reduced matrix as displacements of all beads, none of the centre bead."""
    right = right / right[np.abs(right).argmax()]
    left = left / np.vdot(left, right).conj()
    return Mode(complex(rate), _spread(right, axes, spatial), _spread(left, axes, spatial))


def _spread(vector: Array, axes: list[int], spatial: System) -> Array:
    n = spatial.shape[0]
    spread = np.zeros((n, 3), dtype=complex)
    spread[np.ix_(np.arange(n) != spatial.centre, axes)] = vector.reshape(n - 1, len(axes))
    return spread
