"""Fixtures of the tests of reduced models."""

import pytest
import torch


@pytest.fixture(autouse=True)
def one_thread():
    """Byte-identical results need one thread."""
    torch.set_num_threads(1)
