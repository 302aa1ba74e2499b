"""The explorer of the model that comes along: its forecasts are Python's anywhere in the range, and quick.

`pytest -s` prints how close and how quick.
"""

from statistics import median

import numpy as np
import pytest
from browser import opened_page
from explorer_page import CLOSE, distance, forecast, make

from sedfiber.reduced.dataset_file import write_dataset
from sedfiber.reduced.forecaster import load_plain_model
from sedfiber.reduced.model_folder import SHIPPED
from sedfiber.study.hard_cases.training_cases import simulated

pytestmark = pytest.mark.slow

TIMES = np.linspace(0.0, 700.0, 400)  # the study's longest fall
COMPUTED = "() => Number(document.querySelector('#milliseconds').textContent.split(' ')[0])"


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """With one simulated fall to show."""
    folder = tmp_path_factory.mktemp("explorer")
    write_dataset(simulated(31, (300.0,), (7,)), folder / "falls.parquet")
    make(SHIPPED, folder / "falls.parquet", output=folder / "explorer.html")
    with opened_page() as page:
        page.emulate_media(reduced_motion="reduce")
        page.goto((folder / "explorer.html").as_uri())
        yield page
        assert page.complaints == []


def starts(count: int) -> list[tuple[float, float]]:
    """Corners of the range, θ₀ = 0 at its largest ℬ, the hardest, and ``count`` at random, even in ln ℬ and in θ₀."""
    within, rng = load_plain_model().model.scales, np.random.default_rng(7)
    edges = [(within.B_max, 0.0), (within.B_max, within.theta0_max), (within.B_min, -within.theta0_max)]
    B = np.exp(rng.uniform(np.log(within.B_min), np.log(within.B_max), count))
    theta0 = rng.uniform(-within.theta0_max, within.theta0_max, count)
    return edges + [(float(one), float(other)) for one, other in zip(B, theta0, strict=True)]


def test_forecasts_are_those_of_python_anywhere_in_the_range(page):
    model = load_plain_model()
    apart = [distance(forecast(page, *start, TIMES), model.forecast(*start, TIMES)[..., :2]) for start in starts(40)]
    print(f"explorer and Python differ by {max(apart):.1e} L at most, over {len(apart)} starts")
    assert max(apart) < CLOSE


def test_how_long_a_forecast_takes_is_measured(page):
    """Said, not asserted: what the page itself shows, for one start after the other."""
    taken = []
    for B, theta0 in starts(40):
        for field, value in (("#B", B), ("#theta", np.degrees(theta0))):
            page.fill(field, repr(float(value)))
            page.press(field, "Enter")
        taken.append(page.evaluate(COMPUTED))
    print(f"computed in {median(taken):.0f} ms in the median, {max(taken):.0f} ms at most, over {len(taken)} starts")
    assert min(taken) > 0.0
