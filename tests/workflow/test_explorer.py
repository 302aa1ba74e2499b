"""The explorer in a real browser: its forecasts are Python's, and it is used by keyboard, offline and on a phone."""

import numpy as np
import pytest
import torch
from browser import opened_page
from explorer_page import CLOSE, distance, forecast, make

from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.forecaster import load_model
from sedfiber.reduced.measures import forecast_error
from sedfiber.reduced.model_files import save_forecast_model
from sedfiber.reduced.neural_ode import NeuralOde
from sedfiber.reduced.pod import ModalBasis
from sedfiber.reduced.scaling import Scales
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings
from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE
from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, write_terminal_curve

pytestmark = pytest.mark.slow

SIMULATED, ELSEWHERE = ("200", "37.5"), ("250", "20")  # ℬ and θ₀ in degrees
DARK = """canvas => {
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let dark = 0;
  for (let i = 0; i < data.length; i += 4) dark += data[i + 3] > 200 && data[i] + data[i + 1] + data[i + 2] < 60;
  return dark;
}"""


@pytest.fixture(scope="module")
def page(explorer):
    """The page as it comes, for a reader who has asked for little motion, so that nothing moves by itself."""
    with opened_page() as page:
        page.emulate_media(reduced_motion="reduce")
        page.goto(explorer.as_uri())
        yield page


def choose(page, B: str, degrees: str) -> None:
    """Write both numbers into their fields."""
    for field, value in (("#B", B), ("#theta", degrees)):
        page.fill(field, value)
        page.press(field, "Enter")


def shown(page, name: str) -> str:
    """The words in the element of that id."""
    return page.inner_text(f"#{name}")


@pytest.mark.parametrize(
    "B, theta0", [(100.0, 0.0), (200.0, 10 * np.pi / 48), (137.0, 0.31), (251.0, -0.9), (400.0, -1e-3), (333.3, 1.3)]
)
def test_forecasts_are_those_of_python(page, trained_model, B, theta0):
    """On the study's grid and off it, mirror images too, at uneven times."""
    t = np.cumsum(np.random.default_rng(0).uniform(0.0, 2.0, size=100))
    expected = load_model(trained_model).forecast(B, theta0, t)
    assert distance(forecast(page, B, theta0, t), expected[..., :2]) < CLOSE
    assert page.evaluate("sedfiber.evaluations") < 600


def test_an_encoder_that_sees_the_elasto_gravitational_number(page, dataset, tmp_path):
    """Its matrix changes with ℬ; random weights will do."""
    rng, d, scales = np.random.default_rng(0), 3, Scales(7, 100.0, 400.0, 1.3)
    modes = np.zeros((8, 7, 3))
    modes[:, :, :2] = np.linalg.qr(rng.normal(size=(14, 8)))[0].T.reshape(8, 7, 2)
    basis = ModalBasis(modes.reshape(8, 21), 4, rng.uniform(0.01, 0.1, size=8))
    autoencoder = Autoencoder("double", d, basis, scales, AutoencoderSettings((12,), encoder_hidden=4), 0)
    with torch.no_grad():  # the change with ℬ starts at zero
        autoencoder.encoder.change[-1].weight += 0.1
    node = NeuralOde((12, 20), 0.1, torch.full((d,), 0.3), torch.full((d + 2,), 0.1), 0)
    save_forecast_model(ForecastModel(autoencoder, node, 1e-9, 1e-11), tmp_path, {})
    write_terminal_curve(TerminalCurve.between(100.0, 400.0, 7), tmp_path / CURVE)
    make(tmp_path, dataset, output=tmp_path / "explorer.html")
    t = np.linspace(0.0, 30.0, 40)
    other = page.context.browser.new_page()
    other.goto((tmp_path / "explorer.html").as_uri())
    assert distance(forecast(other, 222.0, 0.7, t), load_model(tmp_path).forecast(222.0, 0.7, t)[..., :2]) < CLOSE
    other.close()


@pytest.mark.parametrize("given", ["99, 0.5, [1]", "200, 1.5, [1]", "200, 0.5, [2, 1]", "200, 0.5, []", "NaN, 0, [1]"])
def test_a_script_that_asks_for_what_the_model_does_not_know_is_refused(page, given):
    """Outside the training range, and times that do not ascend."""
    error = f"() => {{ try {{ sedfiber.forecast({given}); }} catch (error) {{ return error.name; }} }}"
    assert page.evaluate(error) == "RangeError"


@pytest.mark.parametrize("degrees", ["37.5", "-37.5", "20"])
def test_numbers_are_those_of_python(page, trained_model, degrees):
    """Settling time, terminal speed, and how far the ends are apart at rest."""
    choose(page, "200", degrees)
    model = load_model(trained_model)
    fall, (terminal, velocity) = model.settle(200.0, np.radians(float(degrees))), model.curve(200.0)
    assert float(shown(page, "settling").split()[0]) == pytest.approx(fall.metadata["settling_time"], abs=0.06)
    assert shown(page, "speed") == f"{np.linalg.norm(velocity):.3f} Uₛ"
    assert shown(page, "end-to-end") == f"{np.linalg.norm(terminal[0] - terminal[-1]) / 14:.3f} L"
    assert float(shown(page, "milliseconds").split()[0]) > 0


def test_errors_are_those_of_python(page, falls, trained_model):
    """The largest E, to the digits shown and to what lies between the samples that the page holds."""
    choose(page, *SIMULATED)
    fall = falls[1]
    truth = forecast_error(fall.positions, load_model(trained_model).forecast(fall.B, fall.theta0, fall.t))
    mantissa, exponent = shown(page, "largest-error").split("×10")
    exponent = exponent.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    assert float(f"{mantissa}e{exponent}") == pytest.approx(truth.total.max(), rel=0.1)


@pytest.mark.parametrize("sign", ["", "-"])
def test_a_simulated_fall_is_drawn_with_its_errors(page, sign):
    """In black, the mirror image for a negative angle."""
    choose(page, SIMULATED[0], sign + SIMULATED[1])
    page.press("#time-slider", "End")
    assert page.eval_on_selector("#close-up", DARK) > 100
    assert page.is_visible("#errors") and page.eval_on_selector("#errors", DARK) > 50
    assert shown(page, "settling-simulated").startswith("simulated: ")
    assert not page.is_visible("text=No fall was simulated")


def test_mirror_images_have_the_same_errors(page):
    """Forecast and simulated fall are mirrored alike."""
    shown_errors = []
    for sign in ("", "-"):
        choose(page, SIMULATED[0], sign + SIMULATED[1])
        shown_errors.append((shown(page, "largest-error"), shown(page, "settling")))
    assert shown_errors[0] == shown_errors[1]


def test_where_nothing_was_simulated_the_page_says_so(page):
    """No black bead, no curve."""
    choose(page, *ELSEWHERE)
    assert page.eval_on_selector("#close-up", DARK) == 0
    assert not page.is_visible("#errors") and page.is_visible("text=No fall was simulated")
    assert shown(page, "settling-simulated") == "not simulated"
    assert page.input_value("#falls") == ""


def what_follows(page, field: str) -> list[str]:
    """A slider's number field, a number of the forecast, and the picture."""
    return [
        page.input_value(field),
        shown(page, "settling"),
        page.eval_on_selector("#whole-fall", "c => c.toDataURL()"),
    ]


@pytest.mark.parametrize("slider, field", [("#B-slider", "#B"), ("#theta-slider", "#theta")])
def test_sliders_are_moved_by_the_arrow_keys(page, slider, field):
    """Field, picture and numbers follow, and the way back leads back; what has the focus is seen."""
    choose(page, *SIMULATED)
    state = what_follows(page, field)
    page.focus(slider)
    page.press(slider, "ArrowRight")
    assert all(one != other for one, other in zip(state, what_follows(page, field), strict=True))
    assert page.eval_on_selector(slider, "slider => getComputedStyle(slider).outlineStyle") == "solid"
    page.press(slider, "ArrowLeft")
    assert what_follows(page, field) == state


def test_every_control_has_a_name_and_is_reached_by_the_tab_key(page):
    """In the order of reading."""
    page.focus("#B-slider")
    reached = ["B-slider"]
    for _ in range(6):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.id"))
    assert reached == ["B-slider", "B", "theta-slider", "theta", "play", "time-slider", "falls"]
    named = "(element) => element.ariaLabel || element.textContent || element.labels[0].textContent"
    assert all(page.eval_on_selector(f"#{name}", named).strip() for name in reached)


def test_fields_keep_within_their_range(page):
    """A number outside becomes the nearest one allowed; nothing at all changes nothing."""
    choose(page, "5", "-90")
    assert (page.input_value("#B"), page.input_value("#theta")) == ("100", "-75")
    choose(page, "", "10")
    assert (page.input_value("#B"), page.input_value("#theta")) == ("100", "10")


def test_the_list_and_the_map_lead_to_simulated_falls(page):
    """A click near a dot chooses it."""
    choose(page, *ELSEWHERE)
    page.select_option("#falls", label="ℬ = 300, θ₀ = 26.25° (k = 7)")
    assert (page.input_value("#B"), page.input_value("#theta")) == ("300", "26.25")
    width, height = page.eval_on_selector("#map", "canvas => [canvas.clientWidth, canvas.clientHeight]")
    middle = {"x": 38 + (width - 38 - 22) / 2, "y": 10 + (height - 10 - 36) / 2}  # within the margins: ℬ = 200, 37.5°
    page.click("#map", position={"x": middle["x"] + 4, "y": middle["y"] - 4})
    assert (page.input_value("#B"), page.input_value("#theta")) == SIMULATED


def test_time_passes_when_played_and_only_then(page):
    """Paused at first for a reader who asked for little motion; the slider goes to any time by keyboard."""
    choose(page, *SIMULATED)
    page.press("#time-slider", "Home")
    before = shown(page, "time")
    page.wait_for_timeout(200)
    assert shown(page, "time") == before == "t = 0.0 a/Uₛ"
    page.click("#play")
    page.wait_for_timeout(400)
    page.click("#play")
    assert 0.0 < float(shown(page, "time").split()[2]) < 20.0 and shown(page, "play") == "Play"
    page.press("#time-slider", "End")
    assert float(shown(page, "fallen").split()[1]) > 20.0


@pytest.mark.parametrize("start", [SIMULATED, ELSEWHERE])
def test_nothing_overflows_at_phone_width(page, start):
    """360 pixels: one column, whatever is shown."""
    page.set_viewport_size({"width": 360, "height": 740})
    choose(page, *start)
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    right = "() => Math.max(...[...document.querySelectorAll('main *')].map(e => e.getBoundingClientRect().right))"
    assert page.evaluate(right) <= 360
    page.set_viewport_size({"width": 1400, "height": 900})


def test_nothing_is_asked_from_outside_and_nothing_fails(page, explorer):
    """After all of the above."""
    assert page.asked == [explorer.as_uri()]
    assert page.complaints == []
