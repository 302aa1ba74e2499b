"""Contact with a wall: a short-range repulsion of each bead, as from its mirror image."""

from dataclasses import dataclass
from typing import ClassVar

from sedfiber.core.array_types import Band, Positions
from sedfiber.physics.kernel import kernel


@dataclass(frozen=True)
class WallContact:
    """Repulsion from the plane through ``point`` with unit ``normal`` into the fluid; in volume only.

    ``Contact`` with a mirror bead 2h away, for a bead at height ``h < H``, ``H = reach/2 > 1``:
    with ``q = (H² − h²)/(H² − 1)``,

        F = S q⁴ h n,    U = S (H² − h²)⁵ / (10 (H² − 1)⁴)

    in units of ``6πμaU_s`` and of that times ``a``: half the energy of the pair, since the mirror
    bead's half is not the bead's.  ``strength`` S is the force at touching, h = 1.  Source: Dance,
    Climent & Maxey 2004, 2γ = 4.  As a pair's, the force vanishes at h = 0 and is then that
    from the other side: a bead whose centre got through the wall is not brought back.
    """

    strength: float
    reach: float
    point: tuple[float, float, float]
    normal: tuple[float, float, float]

    needs_lab_frame: ClassVar[bool] = True
    banded: ClassVar[bool] = True

    def add_force(self, x: Positions, force: Positions) -> None:
        """Add the repulsion to ``force``, shape (N, 3); beads out of reach are not written to."""
        _add_force(x, self.strength, 0.5 * self.reach, self.point, self.normal, force)

    def add_jacobian(self, x: Positions, jac: Band) -> None:
        """Add ``∂F/∂x`` to the band ``jac``, shape (5, 3, 3, N)."""
        _add_jacobian(x, self.strength, 0.5 * self.reach, self.point, self.normal, jac)

    def energy(self, x: Positions) -> float:
        """``Σ S (H² − h²)⁵ / (10 (H² − 1)⁴)`` over the beads in reach."""
        return _energy(x, self.strength, 0.5 * self.reach, self.point, self.normal)


@kernel()
def _height(x, i, point, normal):
    """Distance of the centre of bead ``i`` from the wall, positive in the fluid."""
    across = (x[i, 0] - point[0]) * normal[0] + (x[i, 1] - point[1]) * normal[1]
    return across + (x[i, 2] - point[2]) * normal[2]


@kernel()
def _energy(x, strength, top, point, normal):
    width = top * top - 1.0
    total = 0.0
    for i in range(x.shape[0]):
        h = _height(x, i, point, normal)
        depth = top * top - h * h
        if depth > 0.0:
            total += depth * (depth / width) ** 4
    return strength / 10.0 * total


@kernel()
def _add_force(x, strength, top, point, normal, force):
    nx, ny, nz = normal
    for i in range(x.shape[0]):
        h = _height(x, i, point, normal)
        if h * h < top * top:
            push = strength * ((top * top - h * h) / (top * top - 1.0)) ** 4 * h
            force[i, 0] += push * nx
            force[i, 1] += push * ny
            force[i, 2] += push * nz


@kernel()
def _add_jacobian(x, strength, top, point, normal, band):
    nx, ny, nz = normal
    n = (float(nx), float(ny), float(nz))
    width = top * top - 1.0
    for i in range(x.shape[0]):
        h = _height(x, i, point, normal)
        if h * h < top * top:
            q = (top * top - h * h) / width
            stiffness = strength * q**3 * (q - 8.0 * h * h / width)
            for k in range(3):
                for w in range(3):
                    band[2, k, w, i] += stiffness * n[k] * n[w]
