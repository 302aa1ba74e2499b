"""Compiled evaluation of the mirror-symmetric networks of `learning.networks`, without torch.

Of a network only what changes along a trajectory is evaluated. With x the displacement from
the origin a, and the parameter b and the origin folded into a first bias,

    raw(x) = ½ [f(a + x; b) + S_out f(a + S_in x; b)],     g(x; a, b) = raw(x) − raw(0)

since raw(0) = ½ (1 + S_out) f(a; b). The last bias cancels. Scales of inputs and outputs and
the ½ are folded into the weights of the first and last layer.

`one` takes a single state, with the two arguments of f side by side. `many` takes rows, with one product of
matrices a layer; in float32 it takes half the time.
"""

from collections.abc import Callable

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import overload
from numpy.polynomial import Chebyshev, Polynomial

from sedfiber.core.array_types import Array
from sedfiber.core.kernel_cache import inlined, kept
from sedfiber.reduced.compiled.network import Network
from sedfiber.reduced.compiled.vector_layer import layer

# What sums may do to run four at a time; the bits stay the same from run to run.
FAST = {"reassoc", "contract", "nsz", "arcp"}
# Without "reassoc", which would cancel the rounding by addition.
_EXACT = {"contract", "nsz", "arcp"}


@inlined
def _power_of_two(_typing, y):
    """2^k of y = k + 1.5·2^52 (float64) or k + 1.5·2^23 (float32), whose last bits are the integer k.

    A conversion to an integer would do the same, but has no vector form before AVX-512.
    """
    width, mantissa, bias = (64, 52, 1023) if y == types.float64 else (32, 23, 127)

    def generate(_context, builder, _signature, arguments):
        integer = ir.IntType(width)
        bits = builder.add(builder.bitcast(arguments[0], integer), ir.Constant(integer, bias))
        return builder.bitcast(builder.shl(bits, ir.Constant(integer, mantissa)), arguments[0].type)

    return y(y), generate


def _exp2_coefficients(degree: int) -> Array:
    """Of the polynomial of this degree for 2^f, |f| ≤ ½: nearly the best; errors 5e-13 at 8, 2e-7 at 5."""
    return Chebyshev.interpolate(np.exp2, degree, [-0.5, 0.5]).convert(kind=Polynomial).coef


def _tanh_kernel(real: type, degree: int, magic: float) -> Callable[[Array], None]:
    """tanh x = 1 − 2/(1 + e^2x), e^2x = 2^k 2^f with k the integer nearest to 2x/ln 2."""
    c0, c1, c2, c3, c4, c5, c6, c7, c8 = (real(c) for c in np.pad(_exp2_coefficients(degree), (0, 8 - degree)))
    rate, top, shift, one, two = (real(c) for c in (2.0 / np.log(2.0), 60.0, magic, 1.0, 2.0))

    @kept(fastmath=_EXACT, error_model="numpy")
    def kernel(x):
        for i in range(x.size):
            y = rate * x[i]
            y = top if y > top else y
            y = -top if y < -top else y
            near = y + shift
            f = y - (near - shift)
            square = f * f
            low = (c0 + f * c1) + square * (c2 + f * c3)
            high = (c4 + f * c5) + square * ((c6 + f * c7) + square * c8)
            x[i] = one - two / (one + (low + square * square * high) * _power_of_two(near))

    return kernel


_tanh64 = _tanh_kernel(np.float64, 8, 1.5 * 2.0**52)
_tanh32 = _tanh_kernel(np.float32, 5, 1.5 * 2.0**23)


def tanh_in_place(x: Array) -> None:
    """Replace x (n,) by its tanh, to 1e-12 in float64 and 4e-7 in float32; not-a-number stays so."""
    (_tanh64 if x.dtype == np.float64 else _tanh32)(x)


@overload(tanh_in_place)
def _tanh_by_precision(x):
    kernel = _tanh64 if x.dtype == types.float64 else _tanh32
    return lambda x: kernel(x)


@kept(fastmath=FAST)
def one(network: Network, bias: Array, x: Array, work: Array, out: Array) -> None:
    """raw(x) (n_out,) of one state x (n_in,); ``bias`` (w_1,) holds a and b, ``work`` (2, 2 max w)."""
    widths, here, there = network.widths, work[0], work[1]
    n, at = widths[0], 0
    for j in range(x.size):
        there[j], there[x.size + j] = x[j], network.signs_in[j] * x[j]
    layer(network.first.ravel(), 0, bias, 0, x.size, n, there, here)
    tanh_in_place(here[: 2 * n])
    for k in range(1, widths.size):
        m = widths[k]
        layer(network.inner, at, network.inner, at + n * m, n, m, here, there)
        tanh_in_place(there[: 2 * m])
        at, n, here, there = at + (n + 1) * m, m, there, here
    _leave(network.last, network.signs_out, here[:n], here[n : 2 * n], out)


@kept(fastmath=FAST)
def _enter(first, signs, bias, x, direct, image):
    """First layer: direct = bias + W x, image = bias + W S x."""
    for i in range(direct.size):
        direct[i] = image[i] = bias[i]
    for j in range(x.size):
        row, a, b = first[j], x[j], signs[j] * x[j]
        for i in range(direct.size):
            direct[i] += row[i] * a
            image[i] += row[i] * b


@kept(fastmath=FAST)
def _leave(last, signs, direct, image, out):
    """Last layer: W (direct + S image)."""
    for i in range(out.size):
        row, sign, total = last[i], signs[i], 0.0
        for j in range(row.size):
            total += row[j] * (direct[j] + sign * image[j])
        out[i] = total


@kept(fastmath=FAST)
def many(network: Network, bias: Array, x: Array, work: Array, out: Array) -> None:
    """raw(x) (n, n_out) of rows x (n, n_in), each with its row of ``bias`` (n, w_1), or all with one (1, w_1).

    ``work`` (2, ≥ 2 n max w) has the precision of the weights and is overwritten.
    """
    rows, widths, at = len(x), network.widths, 0
    n, here, there = widths[0], work[0], work[1]
    _enter_rows(network.first, network.signs_in, bias, x, here[: 2 * rows * n].reshape(2 * rows, n))
    tanh_in_place(here[: 2 * rows * n])
    for k in range(1, widths.size):
        m = widths[k]
        weights, result = network.inner[at : at + n * m].reshape(n, m), there[: 2 * rows * m].reshape(2 * rows, m)
        np.dot(here[: 2 * rows * n].reshape(2 * rows, n), weights, result)
        _add_to_rows(result, network.inner[at + n * m : at + (n + 1) * m])
        tanh_in_place(there[: 2 * rows * m])
        at, n, here, there = at + (n + 1) * m, m, there, here
    _leave_rows(network, here[: 2 * rows * n].reshape(2 * rows, n), there, out)


@kept(fastmath=FAST)
def _enter_rows(first, signs, bias, x, result):
    rows = len(x)
    for s in range(rows):
        _enter(first, signs, bias[s % len(bias)], x[s], result[s], result[rows + s])


@kept(fastmath=FAST)
def _add_to_rows(rows, bias):
    for s in range(len(rows)):
        for i in range(bias.size):
            rows[s, i] += bias[i]


@kept(fastmath=FAST)
def _leave_rows(network, hidden, work, out):
    rows, n_out = out.shape
    both = work[: 2 * rows * n_out].reshape(2 * rows, n_out)
    np.dot(hidden, network.last.T, both)
    for s in range(rows):
        for i in range(n_out):
            out[s, i] = both[s, i] + network.signs_out[i] * both[rows + s, i]
