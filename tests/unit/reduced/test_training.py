"""The optimiser, its schedule and its guards."""

import pytest
import torch

from sedfiber.core.errors import NumericalError
from sedfiber.reduced.training.training import JUMP, MOST_SKIPPED, Descent, cosine_rate, silent, soap

NAMES = ("B = 100, angle_index = 3", "B = 300, angle_index = 5")
WHICH = torch.tensor([0, 1])


def descent_of(*weights, say=silent):
    """The guarded optimiser on some weights, with two trajectories."""
    return Descent(soap(weights), NAMES, "a test", say)


def take(descent, errors):
    """One step down the mean of two errors, one of each trajectory."""
    return descent.step(0.1, errors.mean(), errors, WHICH)


def test_an_ill_conditioned_regression_is_solved():
    """Columns of size 1 to 0.01: plain gradient descent would need thousands of steps."""
    generator = torch.Generator().manual_seed(0)
    x = torch.randn(64, 8, generator=generator) * torch.logspace(0, -2, 8)
    truth = torch.randn(8, 3, generator=generator)
    weights = torch.zeros(8, 3, requires_grad=True)
    descent = descent_of(weights)
    for step in range(500):
        errors = ((x @ weights - x @ truth) ** 2).mean(dim=1)
        last = descent.step(cosine_rate(0.1, step, 500), errors.mean(), errors, torch.zeros(64, dtype=int))
    assert last < 1e-6


def test_rate_rises_then_falls_to_a_thousandth():
    """A short warm-up, then half a cosine."""
    rates = [cosine_rate(1.0, step, 1000) for step in range(1001)]
    assert rates[0] < 0.05 and max(rates) > 0.9 and rates[-1] < 0.0011


@pytest.mark.parametrize(
    ("spoil", "what"),
    [
        (lambda errors: errors / 0, "the loss became inf"),
        (lambda errors: errors * torch.nan, "the loss became nan"),
        (lambda errors: errors * 4 * JUMP, "the loss became 1.62e+03"),
        (lambda errors: 1.0 + (errors * 0).sqrt(), "the gradient's square became nan"),
        (lambda errors: 2.0 + 2e20 * (errors - errors.detach()), "the gradient's square became inf"),
    ],
)
def test_a_bad_step_is_skipped_and_said(spoil, what):
    """The weights go back to the last good ones, the rate is halved, the next step is taken as usual."""
    said, weight = [], torch.ones(2, requires_grad=True)
    descent = descent_of(weight, say=said.append)
    take(descent, weight**2)
    take(descent, weight**2)
    take(descent, torch.stack([weight[0] ** 2, spoil(weight**2)[1]]))
    assert said == [f"a test: {what} in the trajectory with {NAMES[1]}; step skipped, learning rate halved"]
    assert torch.equal(weight, torch.ones(2))
    take(descent, weight**2)
    assert descent.optimiser.param_groups[0]["lr"] == 0.05
    assert torch.isfinite(weight).all() and (weight < 1).all()


def test_averages_of_the_optimiser_never_see_a_bad_step():
    """With and without a NaN in between, everything that SOAP remembers is the same."""
    memories = []
    for spoilt in (False, True):
        weight = torch.ones(2, 2, requires_grad=True)
        descent = descent_of(weight)
        for _ in range(3):
            take(descent, (weight**2).sum(dim=1))
        if spoilt:
            take(descent, (weight * torch.nan).sum(dim=1))
        memories.append(descent.optimiser.state[weight])
    for name in ("exp_avg", "exp_avg_sq"):
        assert torch.equal(memories[0][name], memories[1][name])


def test_one_bad_step_too_many_stops_with_the_trajectory():
    """One line: the stage, what was wrong, the trajectory, and what to try."""
    weight = torch.ones(2, requires_grad=True)
    descent = descent_of(weight)
    for _ in range(MOST_SKIPPED):
        take(descent, torch.nan * weight)
    with pytest.raises(
        NumericalError, match=f"a test: the loss became nan in the trajectory with {NAMES[0]}, 6 bad"
    ) as e:
        take(descent, torch.nan * weight)
    assert "try a smaller learning rate" in str(e.value) and "\n" not in str(e.value)
