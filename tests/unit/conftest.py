"""Fixtures of the unit tests."""

import pytest

from tiny_fiber import training_set


@pytest.fixture
def training():
    """Three ℬ, four even angles; a test may spoil its own."""
    return training_set()
