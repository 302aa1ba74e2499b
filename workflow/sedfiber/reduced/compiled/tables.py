"""The arrays of a trained model as the kernels use them, from the tensors of its file.

Scales are folded into the weights: those of h and of the rates into the neural ODE, σ into the
decoder, L/2 into the modes. Of both networks' context [b, h_term] only a first bias is left,

    bias = bias_0 + C [b, h_term],

with C = 0 for a decoder that sees neither; h_term enters by its even part.
"""

from typing import NamedTuple

import numpy as np

from sedfiber.core.array_types import Array
from sedfiber.reduced.compiled.network import BLOCK, Network

Tensors = dict[str, np.ndarray]


class Tables(NamedTuple):
    """d latent variables, r modes, N beads; W = N·dim for the ``dim`` coordinates of the output.

    ``*_bias`` is bias_0 (w_1,) and ``*_context`` is C (w_1, 1 + d) of each network; ``damping``
    (d,) is A's diagonal. ``pick`` (d, r) is P₀, ``modes`` (r, W) is (L/2) Φ.
    """

    rates: Network
    rates_bias: Array
    rates_context: Array
    damping: Array
    decoder: Network
    decoder_bias: Array
    decoder_context: Array
    pick: Array
    modes: Array
    half_length: float


class Encoder:
    """h = (P + Q(b)) Φ X̌ of shapes in units of ``a``: Φ/(L/2) is ``modes`` (r, 3N)."""

    def __init__(self, tensors: Tensors, half_length: float) -> None:
        self.modes = _exact(tensors["autoencoder.modes"]) / half_length
        self.matrix, self.allowed = (_exact(tensors[f"autoencoder.encoder.{name}"]) for name in ("matrix", "allowed"))
        self.change = _layers(tensors, "autoencoder.encoder.change")
        self._fixed = (self.matrix * self.allowed) @ self.modes

    def at(self, b: float) -> Array:
        """The linear map (d, 3N) from a shape to h at the scaled ln ℬ ``b``."""
        if not self.change:
            return self._fixed
        (enter, enter_bias), (leave, leave_bias) = self.change
        change = leave @ np.tanh(enter[:, 0] * b + enter_bias) + leave_bias
        return ((self.matrix + change.reshape(self.matrix.shape)) * self.allowed) @ self.modes


def tables(tensors: Tensors, half_length: float, dim: int) -> Tables:
    """Tables for positions in ``dim`` = 2 or 3 dimensions; KeyError or ValueError for tensors that do not fit."""
    latent_scale, damping = (_exact(tensors[f"node.{name}"]) for name in ("latent_scale", "damping"))
    d, modes = len(latent_scale), _exact(tensors["autoencoder.modes"])
    plane = modes.reshape(len(modes), -1, 3)[:, :, :dim].reshape(len(modes), -1)
    rates = _network(tensors, "node.network", latent_scale, _exact(tensors["node.rate_scale"]))
    decoder = _network(tensors, "autoencoder.decoder", np.ones(d), _exact(tensors["autoencoder.scale"]))
    pick = _exact(tensors["autoencoder.pick"])
    return Tables(*rates, damping, *decoder, pick, np.ascontiguousarray(half_length * plane), half_length)


def _network(tensors: Tensors, name: str, scale_in: Array, scale_out: Array) -> tuple[Network, Array, Array]:
    """A mirror network, its first bias and C; inputs are divided by ``scale_in``, outputs multiplied."""
    first, *inner, last = _layers(tensors, f"{name}.body")
    signs_in, signs_out = (_exact(tensors[f"{name}.{signs}"]) for signs in ("signs_in", "signs_out"))
    n_in = len(signs_in)
    enter, bias = _filled(first[0], 0), _filled(first[1], 0)
    parts = [part.ravel() for w, b in inner for part in (_filled(_filled(w, 0), 1).T, _filled(b, 0))]
    widths = np.array([len(bias), *(len(_filled(b, 0)) for _, b in inner)])
    leave = 0.5 * scale_out[:, None] * _filled(last[0], 1)
    of_x = enter[:, :n_in] / scale_in
    context = np.zeros((len(enter), 1 + n_in))
    if enter.shape[1] > n_in:
        context[:, 0], context[:, 1:] = enter[:, n_in], of_x * (signs_in > 0)
    flat = np.concatenate([np.zeros(0), *parts])
    return Network(np.ascontiguousarray(of_x.T), flat, widths, leave, signs_in, signs_out), bias, context


def _filled(weights: Array, axis: int) -> Array:
    """Zeros appended to an axis of hidden units, to a multiple of the vector layer's block."""
    missing = [(0, -size % BLOCK if k == axis else 0) for k, size in enumerate(weights.shape)]
    return np.pad(weights, missing)


def _layers(tensors: Tensors, name: str) -> list[tuple[Array, Array]]:
    """Weights and biases of a perceptron, layer by layer; none for one that the file does not have."""
    keys = sorted((key for key in tensors if key.startswith(f"{name}.") and key.endswith(".weight")), key=_depth)
    return [(_exact(tensors[key]), _exact(tensors[key.removesuffix("weight") + "bias"])) for key in keys]


def _depth(key: str) -> int:
    return int(key.split(".")[-2])


def _exact(tensor: np.ndarray) -> Array:
    """Stored in float32, used in float64."""
    return np.ascontiguousarray(tensor, dtype=np.float64)
