import json

import numpy as np
import pytest

from sedfiber.core.errors import InputError
from sedfiber.reduced.forecast_start import Start
from sedfiber.reduced.model_files import (
    load_autoencoder,
    load_forecast_model,
    save_autoencoder,
    save_forecast_model,
)
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings
from sedfiber.reduced.training.train_autoencoder import train_autoencoder
from sedfiber.reduced.training.train_node import train_node
from tiny_fiber import settling, training_set

AUTOENCODER = AutoencoderSettings(
    decoder_hidden=(8,), encoder_hidden=4, modes_per_parity=4, samples_per_trajectory=8, batch_size=16, iterations=10
)
NODE = NodeSettings(
    hidden=(8,),
    samples_per_trajectory=8,
    matching_iterations=5,
    matching_batch_size=16,
    rollout_lengths=(4,),
    rollout_iterations=(2,),
    rollout_batch_steps=20,
)


@pytest.fixture(params=["decoder", "double"], scope="module")
def autoencoder(request):
    """Saved and read by every test, changed by none."""
    return train_autoencoder(training_set(), request.param, 2, 0, AUTOENCODER)


@pytest.fixture(scope="module")
def model(autoencoder):
    return ForecastModel(autoencoder, train_node(training_set(), autoencoder, 0, NODE), 1e-6, 1e-8)


def test_autoencoder_comes_back(autoencoder, tmp_path):
    save_autoencoder(autoencoder, tmp_path, {"loss": 0.5})
    loaded = load_autoencoder(tmp_path)
    assert (loaded.variant, loaded.latent_dim, loaded.seed) == (autoencoder.variant, 2, 0)
    assert loaded.scales == autoencoder.scales and loaded.settings == autoencoder.settings
    assert all((loaded.state_dict()[name] == value).all() for name, value in autoencoder.state_dict().items())
    assert json.loads((tmp_path / "card.json").read_text())["notes"] == {"loss": 0.5}


def test_forecast_model_comes_back_whole(model, tmp_path):
    save_forecast_model(model, tmp_path / "new" / "folder", {})
    one = settling(300.0, 9)
    before = model.forecast_many([Start.of(one)], one.t)
    after = load_forecast_model(tmp_path / "new" / "folder").forecast_many([Start.of(one)], one.t)
    np.testing.assert_array_equal(before, after)


def test_same_model_gives_the_same_bytes_and_nothing_else_is_left(model, tmp_path):
    for name in ("one", "two"):
        save_forecast_model(model, tmp_path / name, {"n": 1})
    for file in ("model.safetensors", "card.json"):
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()
    assert len(list((tmp_path / "one").iterdir())) == 2


def test_folder_without_a_model_is_refused(tmp_path):
    with pytest.raises(InputError, match="no readable model"):
        load_forecast_model(tmp_path)


def test_model_of_another_kind_is_refused(autoencoder, tmp_path):
    save_autoencoder(autoencoder, tmp_path, {})
    with pytest.raises(InputError, match="'forecast model'"):
        load_forecast_model(tmp_path)


def test_damaged_weights_are_refused(model, tmp_path):
    save_forecast_model(model, tmp_path, {})
    weights = tmp_path / "model.safetensors"
    weights.write_bytes(weights.read_bytes()[:-8])
    with pytest.raises(InputError, match="damaged or half-written"):
        load_forecast_model(tmp_path)


@pytest.mark.parametrize("text", ["", "[]", "{"])
def test_damaged_card_is_refused(model, tmp_path, text):
    save_forecast_model(model, tmp_path, {})
    (tmp_path / "card.json").write_text(text)
    with pytest.raises(InputError):
        load_forecast_model(tmp_path)


def test_card_that_does_not_fit_the_weights_is_refused(model, tmp_path):
    save_forecast_model(model, tmp_path, {})
    card = json.loads((tmp_path / "card.json").read_text())
    card["autoencoder"]["latent_dim"] = 3
    (tmp_path / "card.json").write_text(json.dumps(card))
    with pytest.raises(InputError, match="does not fit"):
        load_forecast_model(tmp_path)


def test_folder_that_cannot_be_made_is_refused(autoencoder, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot make"):
        save_autoencoder(autoencoder, tmp_path / "file" / "model", {})
