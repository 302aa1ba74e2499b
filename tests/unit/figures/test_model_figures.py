"""The model's block diagram and the reconstruction loss: sizes of the card, connections by variant, spread by seed."""

import copy
import json
from itertools import product

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import same_color
from matplotlib.patches import FancyArrowPatch

from figure_command import draw_words
from sedfiber.commands.cli import main
from sedfiber.figures.blocks import bent
from sedfiber.figures.model_diagram import CONNECTIONS
from sedfiber.figures.model_diagram import draw as draw_model_diagram
from sedfiber.figures.reconstruction import CURVES
from sedfiber.figures.reconstruction import draw as draw_reconstruction

CARD = {
    "kind": "forecast model",
    "autoencoder": {
        "variant": "decoder",
        "latent_dim": 4,
        "scales": {"n_beads": 31},
        "settings": {"modes_per_parity": 12, "encoder_hidden": 16, "decoder_hidden": [64, 32]},
    },
    "neural_ode": {"hidden": [50, 40, 30]},
    "notes": {"node_settings": {"damping": 0.1}},
}
ABSENT = {"none": {"f", "k"}, "encoder": {"k"}, "decoder": {"f"}, "double": set()}  # connections a variant lacks
LETTERS = set("abcdefghijklmno")
each_variant = pytest.mark.parametrize("variant", ABSENT)


def write_card(folder, **changes):
    """CARD with other entries of its autoencoder, as a file."""
    card = copy.deepcopy(CARD)
    card["autoencoder"] |= changes
    path = folder / "card.json"
    path.write_text(json.dumps(card))
    return path


def model_axes(folder, **changes):
    """The axes that all of the diagram is drawn on."""
    return draw_model_diagram(write_card(folder, **changes)).axes[0]


def words(axes):
    """Everything written on axes."""
    return "\n".join(text.get_text() for text in axes.texts)


def connections(axes):
    """Wire of each lettered connection."""
    labelled = [wire for wire in axes.patches if isinstance(wire, FancyArrowPatch) and wire.get_label()]
    return {wire.get_label().removeprefix("connection "): wire for wire in labelled}


@each_variant
def test_the_diagram_is_drawn_from_the_models_card(variant, tmp_path):
    card = write_card(tmp_path, variant=variant, latent_dim=2, scales={"n_beads": 7})
    assert main(draw_words("model_diagram", tmp_path, {"card": card})) == 0
    assert (tmp_path / "x.svg").read_bytes().startswith(b"<?xml")
    assert (tmp_path / "x.png").read_bytes().startswith(b"\x89PNG")


@each_variant
def test_every_connection_has_its_letter_and_the_absent_ones_are_dashed(variant, tmp_path):
    axes = model_axes(tmp_path, variant=variant)
    wires = connections(axes)
    assert set(wires) == LETTERS
    assert all(f"({letter})" in words(axes) for letter in LETTERS)
    assert {letter for letter, wire in wires.items() if wire.get_linestyle() != "-"} == ABSENT[variant]


def test_every_connection_ends_at_a_block(tmp_path):
    """A little beyond its head lies a box, a trapezoid or a junction; only (o) leaves the diagram."""
    axes = model_axes(tmp_path, variant="double")
    blocks = [patch for patch in axes.patches if not isinstance(patch, FancyArrowPatch)]
    outlines = [block.get_path().transformed(block.get_patch_transform()) for block in blocks]
    a = next(text for text in axes.texts if text.get_text() == "(a)")
    origin = np.array(a.get_position()) - CONNECTIONS["a"][0]
    loose = set()
    for letter, (_, *corners) in CONNECTIONS.items():
        before, end = origin + np.array(corners[-2:])
        beyond = end + 0.03 * (end - before) / np.linalg.norm(end - before)
        if not any(outline.contains_point(beyond) for outline in outlines):
            loose.add(letter)
    assert loose == {"o"}


def test_the_sizes_are_the_card_s(tmp_path):
    text = words(model_axes(tmp_path))
    assert "31 beads" in text and "93 coordinates" in text
    assert "93 → 4" in text and "4 → 93" in text
    assert "12 odd and 12 even modes" in text and "P: 4 × 24" in text
    assert "5:64:32:24" in text  # h + h_term and ln ℬ give 24 modal coefficients
    assert "5:50:40:30:\n6" in text  # h + h_term and ln ℬ give F_h and two components of G_c
    assert "A = 0.1 diag(std h)" in text


def test_a_decoder_without_B_has_one_input_less_and_a_changed_encoder_is_named(tmp_path):
    text = words(model_axes(tmp_path, variant="encoder"))
    assert "4:64:32:24" in text and "5:64:32:24" not in text
    assert "P + Q" in text and "1:16:96" in text


def test_a_short_fiber_has_no_more_modes_than_coordinates(tmp_path):
    """Seven beads about the centre bead: twelve planar coordinates, six odd and six even."""
    text = words(model_axes(tmp_path, scales={"n_beads": 7}))
    assert "6 odd and 6 even modes" in text and "21 → 4" in text


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"variant": "triple"}, "'triple' is not allowed; give one of none, encoder, decoder, double"),
        ({"latent_dim": 0}, "latent_dim: 0 is not allowed"),
        ({"scales": {}}, "n_beads"),
        ({"settings": {"modes_per_parity": 12, "encoder_hidden": 16, "decoder_hidden": 64}}, "card.json"),
    ],
)
def test_a_bad_card_is_one_line(change, named, tmp_path, capsys):
    refuse(write_card(tmp_path, **change), named, capsys)


@pytest.mark.parametrize("text", ["no JSON", "[]", json.dumps(CARD | {"neural_ode": {}}), '{"kind": "autoencoder"}'])
def test_what_is_no_card_of_a_forecast_model_is_refused(text, tmp_path, capsys):
    path = tmp_path / "card.json"
    path.write_text(text)
    refuse(path, "not the card.json of a forecast model", capsys)


def test_a_missing_card_is_refused(tmp_path, capsys):
    refuse(tmp_path / "card.json", "not the card.json of a forecast model", capsys)


def refuse(card, named, capsys):
    """One line that names what is wrong; nothing is drawn."""
    assert main(draw_words("model_diagram", card.parent, {"card": card})) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and named in error
    assert not card.with_name("x.svg").exists()


def test_a_sketched_fiber_is_an_arc_about_its_centre_bead():
    """Tangent angle φ s, s from −1 to 1, half length ℓ: the ends are at x = ±ℓ sin(φ)/φ, y = ℓ (1 − cos φ)/φ."""
    beads = bent(0.0, 1.2, 2.0, n_beads=201)
    end = [2.0 * np.sin(1.2) / 1.2, 2.0 * (1.0 - np.cos(1.2)) / 1.2]
    np.testing.assert_allclose(beads[-1], end, rtol=1e-4)
    np.testing.assert_allclose(beads[0], [-end[0], end[1]], rtol=1e-4)
    assert not beads[100].any()


def losses():
    """Three seeds of every variant with losses 1, 2 and 6 in 10⁴, the worst sample ten times as far; POD once."""
    autoencoders = product(("none", "encoder", "decoder", "double"), (1, 2), enumerate((1e-4, 2e-4, 6e-4)), "AB")
    rows = [("autoencoder", v, d, seed, s, loss, 10 * loss) for v, d, (seed, loss), s in autoencoders]
    rows += [("pod", None, d, None, s, 1e-1, 1.0) for d, s in product((1, 2), "AB")]
    names = ["method", "variant", "latent_dim", "seed", "test_set", "loss", "loss_worst_sample"]
    return pd.DataFrame(rows, columns=names)


def test_a_mark_is_the_mean_over_seeds_and_its_bar_goes_from_the_least_to_the_greatest():
    for panel in draw_reconstruction(losses()).axes[:2]:
        assert len(panel.containers) == len(CURVES)
        line, _, (bars,) = panel.containers[0]
        np.testing.assert_allclose(line.get_ydata().astype(float), 3e-4)
        for bar in bars.get_segments():
            np.testing.assert_allclose(bar[:, 1], [1e-4, 6e-4])


def test_the_worst_sample_is_the_worst_of_all_seeds_and_needs_its_column():
    def worst(table):
        lines = draw_reconstruction(table).axes[0].get_lines()
        return [line.get_ydata() for line in lines if "worst sample" in line.get_label()]

    (drawn,) = worst(losses())
    np.testing.assert_allclose(drawn, 6e-3)
    assert worst(losses().drop(columns="loss_worst_sample")) == []


def test_each_variant_has_its_diagram_in_the_colour_of_its_curve():
    panel, _, *diagrams = draw_reconstruction(losses()).axes
    assert [axes.get_title(loc="left")[:3] for axes in diagrams] == ["(b)", "(c)", "(d)", "(e)"]
    for axes, (variant, absent), curve in zip(diagrams, ABSENT.items(), panel.containers, strict=False):
        assert set(connections(axes)) == {"f", "k"} - absent
        assert variant in axes.get_title(loc="left") or variant == "none"
        trapezoid = next(patch for patch in axes.patches if not isinstance(patch, FancyArrowPatch))
        assert same_color(trapezoid.get_edgecolor(), curve.lines[0].get_color())
