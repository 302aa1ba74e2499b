"""The numbers of Tsitouras' Runge–Kutta pair of orders 5 and 4 with a continuous extension of order 4.

    k_i = f(y + Δ Σ_j A_ij k_j),   y(t + Δ) = y + Δ Σ_i b_i k_i,   b = last row of A
    err = Δ Σ_i e_i k_i,           y(t + θΔ) = y + Δ Σ_i k_i Σ_m D_mi θ^(m+1)

Source of A and e: C. Tsitouras, Comput. Math. Appl. 62 (2011) 770–775; of the extension: the
same author, in its expanded form in OrdinaryDiffEq.jl and Diffrax. The last stage is the first
of the next step, so that a step costs six evaluations; the extension costs none.
"""

import numpy as np

from sedfiber.core.array_types import Array

STAGES = 7
DEGREE = 4  # of the polynomial that continues a step
ORDER = 5.0

A = np.zeros((STAGES, STAGES))
A[1, :1] = 0.161
A[2, :2] = -0.008480655492356989, 0.335480655492357
A[3, :3] = 2.897153057105493, -6.359448489975075, 4.3622954328695815
A[4, :4] = 5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525
A[5, :5] = 5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401, -0.028269050394068383
A[6, :6] = (
    0.09646076681806523,
    0.01,
    0.4798896504144996,
    1.379008574103742,
    -3.290069515436081,
    2.324710524099774,
)
ERROR = np.array(
    [
        -0.00178001105222577714,
        -0.0008164344596567469,
        0.007880878010261995,
        -0.1447110071732629,
        0.5823571654525552,
        -0.45808210592918697,
        1.0 / 66.0,
    ]
)


def _extension() -> Array:
    """D (4, 7): the published factors, multiplied out; the row is the power of θ less one."""
    quadratics = [  # b_i(θ) = factor · θ² (θ² + p θ + q), but for the first, which has a linear term
        (0.1017, -2.1966568338249754, 1.2949852507374631),
        (2.490627285651252793, -2.38535645472061657, 1.57803468208092486),
        (-16.54810288924490272, -1.21712927295533244 - 0.61620406037800089, 1.21712927295533244 * 0.61620406037800089),
        (
            47.37952196281928122,
            -1.203071208372362603 - 0.658047292653547382,
            1.203071208372362603 * 0.658047292653547382,
        ),
        (-34.87065786149660974, -1.2 - 2.0 / 3.0, 0.8),
        (2.5, -1.6, 0.6),
    ]
    columns = [factor * np.array([0.0, q, p, 1.0]) for factor, p, q in quadratics]
    first = np.polynomial.Polynomial([0.7139816917074209, -1.4364028541716351, 1.0])
    first *= -1.0530884977290216 * np.polynomial.Polynomial([-1.3299890189751412, 1.0])
    return np.array([first.coef, *columns]).T.copy()


EXTENSION = _extension()
