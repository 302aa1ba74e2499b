"""The model once more, in plain NumPy straight from its definitions, to check the package against.

Nothing here is shared with the package: energies are sums as DESIGN §1 writes them, forces
are their complex-step gradients, mobilities are built pair by pair from broadcast arrays, and
states are absolute positions.  Slow and short on purpose.
"""

import numpy as np
from scipy.integrate import solve_ivp

STEP = 1e-30  # of the complex step: no subtraction, so no round-off


def bond_lengths(x):
    """Lengths of consecutive bonds of positions (..., N, d)."""
    b = np.diff(x, axis=-2)
    return np.sqrt((b * b).sum(-1))


def stretching_energy(x, modulus):
    """``ℰ Σ_bonds (r/2 − 1)²`` of positions (..., N, d)."""
    return modulus * ((bond_lengths(x) / 2 - 1) ** 2).sum(-1)


def bending_energy(x, modulus):
    """``(ℰ/8) Σ_angles (1 − cos θ)`` of positions (..., N, d)."""
    t = np.diff(x, axis=-2) / bond_lengths(x)[..., None]
    return modulus / 8 * (1 - (t[..., 1:, :] * t[..., :-1, :]).sum(-1)).sum(-1)


def gravity_energy(x, modulus=None):
    """``Σ y`` of positions (..., N, d): each bead weighs one unit of force."""
    return x[..., 1].sum(-1)


def total_energy(x, modulus):
    """All three together."""
    return stretching_energy(x, modulus) + bending_energy(x, modulus) + gravity_energy(x)


def gradient(energy, x):
    """``∂energy/∂x`` (N, d) by the complex step: exact to round-off for any analytic energy."""
    shifts = 1j * STEP * np.eye(x.size).reshape(x.size, *x.shape)
    return (energy(x + shifts).imag / STEP).reshape(x.shape)


def rpy(x, overlap=False):
    """Rotne–Prager–Yamakawa mobility (N d, N d) as DESIGN §1 writes it, self block 1."""
    n, d = x.shape
    r = x[:, None] - x[None]
    dist = np.sqrt((r * r).sum(-1)) + np.eye(n)
    identity = (3 / (4 * dist)) * (1 + 2 / (3 * dist**2))
    dyad = (3 / (4 * dist)) * (1 - 2 / dist**2)
    if overlap:
        near = dist < 2
        identity = np.where(near, 1 - 9 * dist / 32, identity)
        dyad = np.where(near, 3 * dist / 32, dyad)
    unit = r / dist[..., None]
    blocks = identity[..., None, None] * np.eye(d) + dyad[..., None, None] * unit[..., :, None] * unit[..., None, :]
    blocks[np.arange(n), np.arange(n)] = np.eye(d)
    return blocks.transpose(0, 2, 1, 3).reshape(n * d, n * d)


def velocity(x, modulus):
    """``M(x) F(x)`` (N, d) with plain RPY."""
    force = -gradient(lambda p: total_energy(p, modulus), x)
    return (rpy(x) @ force.ravel()).reshape(x.shape)


def integrate(x, modulus, t, tolerance=1e-10, jacobian=None):
    """Positions (T, N, d) at the times ``t`` by SciPy's Radau.

    ``jacobian(x)`` only speeds up Newton's iterations inside a step; without it SciPy takes
    differences, and the solution is the same to the tolerance.
    """
    solution = solve_ivp(
        lambda _, y: velocity(y.reshape(x.shape), modulus).ravel(),
        (t[0], t[-1]),
        x.ravel(),
        method="Radau",
        t_eval=t,
        rtol=tolerance,
        atol=tolerance,
        jac=None if jacobian is None else lambda _, y: jacobian(y.reshape(x.shape)),
    )
    assert solution.success, solution.message
    return solution.y.T.reshape(-1, *x.shape)
