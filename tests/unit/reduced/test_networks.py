import pytest
import torch

from sedfiber.reduced.networks import MirrorNetwork

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


PARAMETER = torch.linspace(-1, 1, 6, dtype=torch.float64)[:, None]
ORIGIN = torch.tensor([0.0, 0.0, 0.4], dtype=torch.float64).expand(6, -1)
CONTEXT = torch.cat([PARAMETER, ORIGIN], dim=1)


def test_vanishes_at_rest_for_every_parameter(network):
    assert network(torch.zeros(6, 3, dtype=torch.float64), CONTEXT, network.rest(CONTEXT)).abs().max() < 1e-15


def test_mirror_image_gives_the_mirror_image(network, x):
    direct, image = network(x, CONTEXT, network.rest(CONTEXT)), network(x * SIGNS_IN, CONTEXT, network.rest(CONTEXT))
    torch.testing.assert_close(image, SIGNS_OUT * direct, atol=1e-14, rtol=0)


def test_depends_on_the_parameter(network, x):
    shifted = torch.cat([PARAMETER + 0.5, ORIGIN], dim=1)
    assert (network(x, CONTEXT, network.rest(CONTEXT)) - network(x, shifted, network.rest(shifted))).abs().max() > 1e-3


def test_differences_do_not_depend_on_the_origin_where_the_place_is_the_same(network, x):
    """Moving the origin by s and x by −s leaves f(a + x) alone, so differences in x too."""
    step = torch.tensor([0.0, 0.0, 0.1], dtype=torch.float64)
    moved = torch.cat([PARAMETER, ORIGIN + step], dim=1)
    here = network(x, CONTEXT, network.rest(CONTEXT)) - network(2 * x, CONTEXT, network.rest(CONTEXT))
    there = network(x - step, moved, network.rest(moved)) - network(2 * x - step, moved, network.rest(moved))
    torch.testing.assert_close(here, there, atol=1e-14, rtol=0)
