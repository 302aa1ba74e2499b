"""Small multilayer perceptrons that respect the mirror symmetry and vanish at rest.

Inputs and outputs are either odd or even under the mirror, given by signs S = ±1 for each
component. From any perceptron f(x; b) the network

    g(x; b) = ½ [f(x; b) + S_out f(S_in x; b)] − ½ (1 + S_out) f(0; b)

satisfies g(S_in x; b) = S_out g(x; b) and g(0; b) = 0 exactly, for every set of weights.
"""

from itertools import pairwise

import torch
from torch import Tensor, nn


def perceptron(sizes: list[int], generator: torch.Generator) -> nn.Sequential:
    """Linear layers of ``sizes`` with tanh between them; Glorot normal weights, zero biases."""
    layers: list[nn.Module] = []
    for n_in, n_out in pairwise(sizes):
        layer = nn.Linear(n_in, n_out)
        nn.init.xavier_normal_(layer.weight, generator=generator)
        nn.init.zeros_(layer.bias)
        layers += [layer, nn.Tanh()]
    return nn.Sequential(*layers[:-1])


class MirrorNetwork(nn.Module):
    """g(x; b) above: x (S, n_in) and b (S, k) give (S, n_out); k = 0 for no parameter."""

    def __init__(
        self,
        signs_in: Tensor,
        signs_out: Tensor,
        n_parameters: int,
        hidden: tuple[int, ...],
        generator: torch.Generator,
    ) -> None:
        super().__init__()
        sizes = [len(signs_in) + n_parameters, *hidden, len(signs_out)]
        self.body = perceptron(sizes, generator)
        self.register_buffer("signs_in", signs_in.clone())
        self.register_buffer("signs_out", signs_out.clone())

    def rest(self, b: Tensor) -> Tensor:
        """f(0; b), shape (S, n_out): constant along a trajectory, so callers may keep it."""
        return self.body(torch.cat([b.new_zeros(len(b), len(self.signs_in)), b], dim=1))

    def forward(self, x: Tensor, b: Tensor, rest: Tensor) -> Tensor:
        """g(x; b), with ``rest`` from the method of that name."""
        both = torch.cat([torch.cat([x, b], 1), torch.cat([x * self.signs_in, b], 1)])
        direct, image = self.body(both).chunk(2)
        return 0.5 * (direct + self.signs_out * image - (1 + self.signs_out) * rest)
