import pytest
import torch

from sedfiber.learning.networks import MirrorNetwork

SIGNS_IN = torch.tensor([-1.0, -1.0, 1.0])
SIGNS_OUT = torch.tensor([-1.0, 1.0, 1.0, -1.0])


@pytest.fixture
def network():
    made = MirrorNetwork(SIGNS_IN, SIGNS_OUT, 1, (7, 7), torch.Generator().manual_seed(3))
    for parameter in made.parameters():
        parameter.data += 0.1 * torch.randn(parameter.shape, generator=torch.Generator().manual_seed(4))
    return made.double().requires_grad_(False)


@pytest.fixture
def x():
    return torch.randn(6, 3, generator=torch.Generator().manual_seed(5), dtype=torch.float64)


B = torch.linspace(-1, 1, 6, dtype=torch.float64)[:, None]


def test_vanishes_at_rest_for_every_parameter(network):
    assert network(torch.zeros(6, 3, dtype=torch.float64), B, network.rest(B)).abs().max() < 1e-15


def test_mirror_image_gives_the_mirror_image(network, x):
    direct, image = network(x, B, network.rest(B)), network(x * SIGNS_IN, B, network.rest(B))
    torch.testing.assert_close(image, SIGNS_OUT * direct, atol=1e-14, rtol=0)


def test_depends_on_the_parameter(network, x):
    shifted = B + 0.5
    assert (network(x, B, network.rest(B)) - network(x, shifted, network.rest(shifted))).abs().max() > 1e-3
