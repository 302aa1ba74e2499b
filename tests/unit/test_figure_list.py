"""The list of figures: every entry fits the module that draws it, and `draw` refuses what does not."""

import inspect
import json
from importlib import import_module
from pathlib import Path

import pytest
import yaml

from figure_command import draw_words
from sedfiber.commands.cli import main

REPOSITORY = Path(__file__).parents[2]
PACKAGE = REPOSITORY / "workflow/sedfiber/figures"
FIGURES = yaml.safe_load((REPOSITORY / "workflow/report/figures.yaml").read_text(encoding="utf-8"))
MODULES = {name: about.get("module", name) for name, about in FIGURES.items()}


@pytest.mark.parametrize("name", FIGURES)
def test_an_entry_names_what_its_module_takes(name):
    """Inputs and options are the parameters of `draw`."""
    about = FIGURES[name]
    draw = import_module(f"sedfiber.figures.{MODULES[name]}").draw
    assert set(inspect.signature(draw).parameters) == {*about["inputs"], *about.get("options", {})}


def test_every_module_that_draws_is_in_the_list():
    """No figure is forgotten."""
    drawing = {path.stem for path in PACKAGE.glob("*.py") if "\ndef draw(" in path.read_text(encoding="utf-8")}
    assert drawing == set(MODULES.values())


@pytest.mark.parametrize(
    ("figure", "inputs", "options", "reason"),
    [
        ("nothing", {}, {}, "sedfiber.figures has no module 'nothing' with a function draw"),
        ("style", {}, {}, "sedfiber.figures has no module 'style' with a function draw"),
        ("lags", {"table": "lags.csv"}, {}, "settings: missing a required argument: 'model'"),
        ("effects", {"table": "effects.csv"}, {"model": "x"}, "settings: got an unexpected keyword argument 'model'"),
        ("effects", {"table": "effects.csv"}, {}, "cannot read the table 'effects.csv'"),
    ],
)
def test_what_no_figure_takes_is_refused_in_one_line(tmp_path, capsys, figure, inputs, options, reason):
    """Nothing is written."""
    assert main(draw_words(figure, tmp_path, inputs, options)) == 1
    message = capsys.readouterr().err
    assert message.startswith("sedfiber draw: ") and reason in message and message.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("no JSON", "settings: not a JSON object ("),
        ("[]", "settings: not a JSON object; give one such as {}"),
        (json.dumps({"inputs": {}}), "options: missing; give it in settings"),
        (
            json.dumps({"inputs": {}, "options": {}, "colour": 1}),
            "settings: unknown key 'colour'; keys are inputs, options",
        ),
    ],
)
def test_settings_that_are_no_settings_are_refused(tmp_path, capsys, text, message):
    words = draw_words("effects", tmp_path, {})
    words[words.index("--settings") + 1] = text
    assert main(words) == 1
    assert capsys.readouterr().err.startswith(f"sedfiber draw: {message}")
