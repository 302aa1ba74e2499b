"""Proper orthogonal decomposition (POD) of residual shapes, with parity under the mirror.

The mirror image M (x → −x, bead order reversed) splits residual shapes into an odd and an
even part. With the mirror images as data the POD modes are odd or even themselves, so the
two families are found separately: the rows of ``modes`` solve

    max Σ_samples |φ·P X̌|²,  φ·φ' = δ,      P = (1 − M)/2 for odd, (1 + M)/2 for even modes

and a shape is X̌ ≈ Σ_j φ_j z_j with z = ``modes`` X̌.
"""

from dataclasses import dataclass

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.reduced.dataset import mirrored

# Modes with less than this share of the leading energy are rounding and are left out.
NEGLIGIBLE = 1e-13


@dataclass(frozen=True)
class ModalBasis:
    """Orthonormal modes, odd ones first: ``modes`` (r, 3N), ``n_odd`` of them odd.

    ``energies`` (r,) is the mean square of each coefficient over the samples.
    """

    modes: Array
    n_odd: int
    energies: Array

    @property
    def signs(self) -> Array:
        """−1 for odd modes, +1 for even ones, shape (r,)."""
        return np.where(np.arange(len(self.modes)) < self.n_odd, -1.0, 1.0)

    def coefficients(self, residual: Array) -> Array:
        """z = modes X̌: (…, 3N) gives (…, r)."""
        return residual @ self.modes.T

    def reconstruct(self, coefficients: Array) -> Array:
        """Σ_j φ_j z_j: (…, r) gives (…, 3N)."""
        return coefficients @ self.modes


def modal_basis(residuals: Array, n_odd: int, n_even: int) -> ModalBasis:
    """The leading odd and even modes of ``residuals``, shape (S, 3N)."""
    images = mirrored(residuals.reshape(len(residuals), -1, 3)).reshape(residuals.shape)
    odd, odd_energy = _leading_modes((residuals - images) / 2, n_odd)
    even, even_energy = _leading_modes((residuals + images) / 2, n_even)
    modes = np.concatenate([odd, even])
    return ModalBasis(modes, len(odd), np.concatenate([odd_energy, even_energy]))


def pod_basis(residuals: Array, latent_dim: int) -> ModalBasis:
    """The ``latent_dim`` most energetic modes of both parities: the POD baseline."""
    full = modal_basis(residuals, latent_dim, latent_dim)
    keep = np.sort(np.argsort(full.energies, kind="stable")[::-1][:latent_dim])
    return ModalBasis(full.modes[keep], int((keep < full.n_odd).sum()), full.energies[keep])


def _leading_modes(samples: Array, count: int) -> tuple[Array, Array]:
    covariance = samples.T @ samples / len(samples)
    energies, vectors = np.linalg.eigh(covariance)
    energies, vectors = energies[::-1], vectors[:, ::-1]
    count = min(count, int((energies > NEGLIGIBLE * energies[0]).sum()))
    modes = vectors[:, :count].T
    # eigh leaves the sign of a vector open; fix it so that a rerun gives the same basis.
    largest = modes[np.arange(len(modes)), np.abs(modes).argmax(axis=1)]
    return modes * np.sign(largest)[:, None], energies[:count]
