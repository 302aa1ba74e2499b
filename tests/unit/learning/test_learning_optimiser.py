import torch

from sedfiber.learning.optimiser import Soap
from sedfiber.learning.training import cosine_rate


def test_solves_an_ill_conditioned_regression():
    generator = torch.Generator().manual_seed(0)
    x = torch.randn(64, 8, generator=generator) * torch.logspace(0, -2, 8)
    truth = torch.randn(8, 3, generator=generator)
    weights = torch.zeros(8, 3, requires_grad=True)
    optimiser = Soap([weights])
    for step in range(500):
        loss = ((x @ weights - x @ truth) ** 2).mean()
        optimiser.zero_grad()
        loss.backward()
        optimiser.learning_rate = cosine_rate(0.1, step, 500)
        optimiser.step()
    assert loss < 1e-6


def test_leaves_frozen_parameters_alone():
    frozen, free = torch.ones(2, 2), torch.ones(2, requires_grad=True)
    optimiser = Soap([frozen, free])
    optimiser.learning_rate = 0.1
    for _ in range(2):
        optimiser.zero_grad()
        (free.square().sum() + frozen.sum()).backward()
        optimiser.step()
    assert (frozen == 1).all() and (free < 1).all()


def test_rate_rises_then_falls_to_a_thousandth():
    rates = [cosine_rate(1.0, step, 1000) for step in range(1001)]
    assert rates[0] < 0.05 and max(rates) > 0.9 and rates[-1] < 0.0011
