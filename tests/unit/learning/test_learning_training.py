"""The optimiser, its schedule and its guards."""

import pytest
import torch

from sedfiber.errors import NumericalError
from sedfiber.learning.training import cosine_rate, descend, soap


def test_an_ill_conditioned_regression_is_solved():
    """Columns of size 1 to 0.01: plain gradient descent would need thousands of steps."""
    generator = torch.Generator().manual_seed(0)
    x = torch.randn(64, 8, generator=generator) * torch.logspace(0, -2, 8)
    truth = torch.randn(8, 3, generator=generator)
    weights = torch.zeros(8, 3, requires_grad=True)
    optimiser = soap([weights])
    for step in range(500):
        loss = ((x @ weights - x @ truth) ** 2).mean()
        last = descend(optimiser, cosine_rate(0.1, step, 500), loss, "a test")
    assert last < 1e-6


def test_rate_rises_then_falls_to_a_thousandth():
    """A short warm-up, then half a cosine."""
    rates = [cosine_rate(1.0, step, 1000) for step in range(1001)]
    assert rates[0] < 0.05 and max(rates) > 0.9 and rates[-1] < 0.0011


@pytest.mark.parametrize(("power", "what"), [(0.5, "gradient became nan"), (-0.5, "loss became inf")])
def test_a_loss_or_gradient_that_is_not_finite_stops_the_training(power, what):
    """√0 is finite but its derivative is not; 1/√0 is not finite itself."""
    weight = torch.zeros(2, requires_grad=True)
    with pytest.raises(NumericalError, match=f"{what} in a test"):
        descend(soap([weight]), 0.1, (weight * 0).pow(power).sum(), "a test")
