"""Mobilities of the form ``M_ii = I``, ``M_ij = c1 I + c2 r̂ r̂ᵀ``: their coefficients, as one inlined function.

For beads ``i ≠ j`` of radius 1 with ``r = x_i − x_j``, in units ``1/(6πμa)``:

    Oseen                       c1 = 3/(4r),             c2 = 3/(4r)
    Rotne–Prager–Yamakawa       c1 = 3/(4r) + 1/(2r³),   c2 = 3/(4r) − 3/(2r³)
    the same, overlap, r < 2    c1 = 1 − 9r/32,          c2 = 3r/32

Oseen is Rotne–Prager without its ``1/r³``.  Sources: Rotne & Prager 1969; Yamakawa 1970.
"""

from sedfiber.physics.kernel import kernel

OSEEN, RPY, RPY_OVERLAP = range(3)
REACH = 2  # beads along the chain that an elastic force on a bead depends on, to each side
# What the sums over pairs may do to run four at a time; the bits stay the same from run to run.
FAST = {"reassoc", "contract", "nsz", "arcp"}


@kernel(inline="always")
def coefficients(r2, form):
    """At one squared distance: ``c1``, ``c2/r²``, ``c1'/r`` and ``(c2/r²)'/r``.

    A distance of zero means the bead itself; every use multiplies what is returned by a
    component of ``r``, ``c1`` excepted.
    """
    r2 = r2 if r2 > 0.0 else 1.0
    q2 = 1.0 / r2
    q = q2**0.5
    a = 0.75 * q
    b = 0.0 if form == OSEEN else 0.5 * q * q2
    near = form == RPY_OVERLAP and r2 < 4.0
    c1 = 1.0 - 0.28125 * r2 * q if near else a + b
    e2 = 0.09375 * q if near else (a - 3.0 * b) * q2
    d1 = -0.28125 * q if near else -(a + 3.0 * b) * q2
    d2 = -0.09375 * q * q2 if near else (15.0 * b - 3.0 * a) * q2 * q2
    return c1, e2, d1, d2
