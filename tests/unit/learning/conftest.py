"""Fixtures of the learning tests."""

import pytest
import torch
from tiny_fiber import TRAINED, settling

from sedfiber.reduced.dataset import Dataset


@pytest.fixture(autouse=True)
def one_thread():
    """Byte-identical results need one thread."""
    torch.set_num_threads(1)


@pytest.fixture
def training():
    """Three ℬ, four even angles."""
    return Dataset(tuple(settling(B, k) for B in TRAINED for k in (0, 6, 12, 18)))
