"""Checks of single values: what passes is converted, what does not is named."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sedfiber.core.errors import InputError, SedfiberError
from sedfiber.core.validation import finite_number, one_of, positive_number, whole_number


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_finite_number_passes_as_number_and_as_text(value):
    """Text from a command and a number from Python mean the same, to the last bit."""
    assert finite_number("key", value) == value
    assert finite_number("key", repr(value)) == value


@given(st.one_of(st.text(), st.none(), st.booleans(), st.sampled_from([math.nan, math.inf, -math.inf, 1j, [], {}])))
def test_positive_number_passes_or_refuses_in_one_line(value):
    """Whatever comes in, either a positive finite float or one line with key and value comes out."""
    try:
        number = positive_number("key", value)
    except InputError as error:
        assert str(error) == f"key: {value!r} is not allowed; give a finite number above 0"
        assert "\n" not in str(error)
    else:
        assert 0 < number < math.inf


@pytest.mark.parametrize("value", [0, -0.0, -1e-300])
def test_zero_and_below_are_not_positive(value):
    """The bound itself is refused."""
    with pytest.raises(InputError):
        positive_number("key", value)


@pytest.mark.parametrize(("value", "number"), [(3, 3), ("3", 3), (3.0, 3), ("1e2", 100)])
def test_whole_numbers_become_ints(value, number):
    """Any spelling of a whole number."""
    assert whole_number("key", value, "a count") == number
    assert isinstance(whole_number("key", value, "a count"), int)


@pytest.mark.parametrize("value", [2.5, "2.5", -1, math.inf, math.nan, True, None])
def test_other_numbers_are_not_whole(value):
    """Fractions, negatives and what is not a number are refused."""
    with pytest.raises(InputError, match="give a count"):
        whole_number("key", value, "a count")


def test_choices_are_listed():
    """The message says what would have been right."""
    assert one_of("key", "b", ["a", "b"]) == "b"
    with pytest.raises(InputError, match=r"^key: 'c' is not allowed; give one of a, b$"):
        one_of("key", "c", ["a", "b"])


def test_input_errors_are_caught_as_the_packages_own():
    """The command line catches one base class."""
    assert issubclass(InputError, SedfiberError)
