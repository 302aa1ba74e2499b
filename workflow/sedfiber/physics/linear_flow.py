"""A flow of constant velocity gradient, ``u∞ = G x``: shear, extension, rotation."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sedfiber.core.array_types import Array, Matrix, Positions
from sedfiber.physics.kernel import kernel

Gradient = tuple[tuple[float, ...], ...]  # three rows of three

_UNIT_RATE: dict[str, Gradient] = {
    "shear": ((0.0, 1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "extension": ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 0.0)),
    "rotation": ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
}
NAMED_FLOWS = tuple(_UNIT_RATE)


def named_gradient(name: str, rate: float) -> Gradient:
    """The gradient of one of ``NAMED_FLOWS``, whose ``rate`` is in ``U_s/a``.

    ``shear``: ``u = rate (y, 0, 0)``; ``extension``, in the plane: ``u = rate (x, −y, 0)``;
    ``rotation``, counterclockwise: ``u = rate (−y, x, 0)``.
    """
    return tuple(tuple(rate * entry for entry in row) for row in _UNIT_RATE[name])


@dataclass(frozen=True)
class LinearFlow:
    """``u∞ = G x`` with ``G_kw = ∂u_k/∂x_w`` in ``U_s/a``, at rest at the origin of the laboratory.

    In the plane only the upper left 2×2 of ``G`` acts.
    """

    gradient: Gradient

    @cached_property
    def strain(self) -> tuple[Array, float]:
        """Rate of strain at the origin, ``(G + Gᵀ)/2``, and its slope, zero: see ``StrainingFlow``."""
        return 0.5 * (self._matrix + self._matrix.T), 0.0

    @cached_property
    def _matrix(self) -> Array:
        return np.array(self.gradient, dtype=float)

    def add_velocity(self, x: Positions, u: Positions) -> None:
        """Add ``G x`` to ``u``, shape (N, d)."""
        _add_velocity(x, self._matrix, u)

    def add_jacobian(self, x: Positions, jac: Matrix) -> None:
        """Add ``G`` to the block of each bead on the diagonal of ``jac``, at least (N d, N d)."""
        _add_jacobian(x.shape[0], x.shape[1], self._matrix, jac)


@kernel()
def _add_velocity(x, g, u):
    n, d = x.shape
    for i in range(n):
        for k in range(d):
            for w in range(d):
                u[i, k] += g[k, w] * x[i, w]


@kernel()
def _add_jacobian(n, d, g, jac):
    for i in range(n):
        for k in range(d):
            for w in range(d):
                jac[i * d + k, i * d + w] += g[k, w]
