"""Every hard case of the list, by the measurements and bounds that the rule ``hard_cases`` uses."""

import pytest

from sedfiber.study.hard_cases.listing import CASES


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_hard_case(case, request):
    """Every number keeps its bound."""
    model = request.getfixturevalue("trained_model") if case.needs_model else None
    found = case.measure(model)
    assert found
    wrong = [f"{one.what}: {one.value:.3g}, bound {one.bound:.3g} {one.note}" for one in found if not one.right]
    assert not wrong, "\n".join(wrong)
