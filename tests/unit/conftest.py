"""Fixtures of the unit tests."""

import pytest

from sedfiber.reduced.dataset import Dataset
from tiny_fiber import TRAINED, settling


@pytest.fixture
def training():
    """Three ℬ, four even angles."""
    return Dataset(tuple(settling(B, k) for B in TRAINED for k in (0, 6, 12, 18)))
