"""The mirror-symmetric networks of `learning.networks` in NumPy, for one state or for rows of them.

    raw(x) = f(a + x; b) + S_out f(a + S_in x; b)

as in `compiled.perceptron`, with the factor ½ and the last bias gone. Both arguments of f pass
together: the first layer makes 2 w_1 numbers from x, the last one takes 2 w_K.
"""

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.reduced.compiled.network import Network


class PlainNetwork:
    """raw(x) − raw(0) of a network whose first bias (w_1,) holds a and b; its outputs are multiplied by ``factor``."""

    def __init__(self, network: Network, bias: Array, factor: Array | float = 1.0) -> None:
        self._enter = np.hstack([network.first, network.signs_in[:, None] * network.first])
        self._bias = np.tile(bias, 2)
        self._inner = _layers(network)
        both = np.hstack([network.last, network.signs_out[:, None] * network.last])
        self._leave = np.ascontiguousarray(both.T * factor)
        self._rest = self._raw(np.zeros(len(network.first)))

    def __call__(self, x: Array) -> Array:
        """Displacements (…, n_in) give (…, n_out)."""
        return self._raw(x) - self._rest

    def _raw(self, x: Array) -> Array:
        hidden = x @ self._enter
        hidden += self._bias
        hidden = np.tanh(hidden, out=hidden).reshape(-1, hidden.shape[-1] // 2)
        for weights, bias in self._inner:
            hidden = hidden @ weights
            hidden += bias
            np.tanh(hidden, out=hidden)
        return hidden.reshape(*x.shape[:-1], -1) @ self._leave


def _layers(network: Network) -> list[tuple[Array, Array]]:
    """Weights (w_k, w_k+1) and biases of the layers between, which lie one after the other."""
    layers, at = [], 0
    for n, m in zip(network.widths[:-1], network.widths[1:], strict=True):
        layers.append((network.inner[at : at + n * m].reshape(n, m), network.inner[at + n * m : at + (n + 1) * m]))
        at += (n + 1) * m
    return layers
