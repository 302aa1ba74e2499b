"""Batched rollouts of the neural ODE with the classical Runge–Kutta method of order 4.

    k₁ = f(y),  k₂ = f(y + τk₁/2),  k₃ = f(y + τk₂/2),  k₄ = f(y + τk₃)
    y ← y + τ (k₁ + 2k₂ + 2k₃ + k₄)/6

with y = [h, c − U_term t] and a step τ of its own for every rollout of the batch, so that
all of them advance along their paths, and not in time, at the same pace.
"""

import torch
from torch import Tensor

from sedfiber.reduced.neural_ode import NeuralOde


def roll_out(node: NeuralOde, h: Tensor, context: Tensor, steps: Tensor) -> tuple[Tensor, Tensor]:
    """States after each step: h (K, S, d) and the drift c − U_term t (K, S, 2), from zero.

    ``h`` (S, d) is the start, ``context`` (S, 1 + d), ``steps`` (K, S) the time steps.
    """
    d, rest = node.latent_dim, node.rest(context)
    state = torch.cat([h, h.new_zeros(len(h), 2)], dim=1)
    history = []
    for step in steps[..., None]:
        k1 = node(state[:, :d], context, rest)
        k2 = node(torch.addcmul(state, step, k1, value=0.5)[:, :d], context, rest)
        k3 = node(torch.addcmul(state, step, k2, value=0.5)[:, :d], context, rest)
        k4 = node(torch.addcmul(state, step, k3)[:, :d], context, rest)
        state = torch.addcmul(state, step, k1 + 2 * (k2 + k3) + k4, value=1 / 6)
        history.append(state)
    states = torch.stack(history)
    return states[..., :d], states[..., d:]
