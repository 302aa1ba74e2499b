"""Small multilayer perceptrons that respect the mirror symmetry and vanish at rest.

Inputs and outputs are either odd or even under the mirror, given by signs S = ±1 for each
component. From any perceptron f(x; b) the network

    g(x; a, b) = ½ [f(a + x; b) + S_out f(a + S_in x; b)] − ½ (1 + S_out) f(a; b)

satisfies g(S_in x; a, b) = S_out g(x; a, b) and g(0; a, b) = 0 exactly, for every set of
weights; a is an origin in the space of x with no odd part, b is a parameter.
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
    """g above: x (S, n_in), origin a (S, n_in) and b (S, k) give (S, n_out).

    Origin and parameter come as one tensor ``context`` = [b, a] (S, k + n_in), or with no
    column at all for a network that has neither.
    """

    signs_in: Tensor
    signs_out: Tensor

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
        self.n_parameters = n_parameters
        self.register_buffer("signs_in", signs_in.clone())
        self.register_buffer("signs_out", signs_out.clone())

    def rest(self, context: Tensor) -> Tensor:
        """f(a; b), shape (S, n_out): constant along a trajectory, so callers may keep it."""
        b, origin = self._split(context)
        return self.body(torch.cat([origin, b], dim=1))

    def forward(self, x: Tensor, context: Tensor, rest: Tensor) -> Tensor:
        """g(x; a, b), with ``rest`` from the method of that name."""
        b, origin = self._split(context)
        direct, image = torch.cat([x + origin, b], 1), torch.cat([x * self.signs_in + origin, b], 1)
        direct, image = self.body(torch.cat([direct, image])).chunk(2)
        return 0.5 * (direct + self.signs_out * image - (1 + self.signs_out) * rest)

    def _split(self, context: Tensor) -> tuple[Tensor, Tensor]:
        if context.shape[1] == 0:
            return context, context.new_zeros(len(context), len(self.signs_in))
        b, origin = context[:, : self.n_parameters], context[:, self.n_parameters :]
        return b, origin * (self.signs_in > 0)
