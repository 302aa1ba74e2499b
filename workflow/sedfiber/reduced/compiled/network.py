"""The weights of a mirror-symmetric network as arrays; `perceptron` says what is computed from them."""

from typing import NamedTuple

import numpy as np

from sedfiber.core.array_types import Array

BLOCK = 16  # outputs that the vector layer makes at a time; hidden layers are filled up to a multiple


class Network(NamedTuple):
    """A network's weights: x enters by ``first`` (n_in, w_1), the result leaves by ``last`` (n_out, w_K).

    ``inner`` holds the layers between, one after the other: weights (w_k, w_k+1) row by row, then
    biases; ``widths`` (K,) are those of the hidden layers, filled up to multiples of 16 with units
    that have no weights, see BLOCK. Signs under the mirror are ±1.
    """

    first: Array
    inner: Array
    widths: Array
    last: Array
    signs_in: Array
    signs_out: Array


def cast(network: Network, dtype: type) -> Network:
    """The same network with weights of another precision; the widths stay integers."""
    parts = [part if part.dtype == np.int64 else np.ascontiguousarray(part, dtype) for part in network]
    return Network(*parts)
