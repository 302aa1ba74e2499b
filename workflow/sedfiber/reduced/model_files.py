"""Models on disk: a folder with ``model.safetensors`` (weights) and ``card.json`` (all else).

Each file is written under a temporary name and renamed, the card last; the card holds the
checksum of the weights, so that a half-finished write is never taken for a model. The
bytes depend on the model only.
"""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load as load_tensors
from safetensors.torch import save as save_tensors
from torch import Tensor

from sedfiber.core.atomic_file import require_folder, write_bytes
from sedfiber.core.checksum import sha256_of_bytes
from sedfiber.core.errors import NumericalError
from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.model_folder import CARD, WEIGHTS, does_not_fit, read_model_folder
from sedfiber.reduced.neural_ode import NeuralOde
from sedfiber.reduced.pod import ModalBasis
from sedfiber.reduced.scaling import Scales
from sedfiber.reduced.torch_forecast import ForecastModel
from sedfiber.reduced.training.settings import AutoencoderSettings


def save_autoencoder(model: Autoencoder, folder: str | Path, notes: dict[str, Any]) -> None:
    """Write an autoencoder; ``notes`` (training facts) go into the card as they are.

    Raises InputError when the folder cannot be written, NumericalError when a weight is not finite.
    """
    card = {"kind": "autoencoder", "autoencoder": _autoencoder_card(model), "notes": notes}
    _write(folder, _prefixed("autoencoder", model), card)


def load_autoencoder(folder: str | Path) -> Autoencoder:
    """Read what `save_autoencoder` wrote; raises InputError for anything else."""
    card, tensors = _read(folder, "autoencoder")
    with _Rebuilding(folder):
        return _rebuild_autoencoder(card, tensors)


def save_forecast_model(model: ForecastModel, folder: str | Path, notes: dict[str, Any]) -> None:
    """Write encoder, decoder, neural ODE and scales together; ``notes`` go into the card.

    Raises InputError when the folder cannot be written, NumericalError when a weight is not finite.
    """
    node = {"hidden": model.node.hidden, "seed": model.node.seed}
    card = {
        "kind": "forecast model",
        "autoencoder": _autoencoder_card(model.autoencoder),
        "neural_ode": node | {"rtol": model.rtol, "atol": model.atol},
        "notes": notes,
    }
    tensors = _prefixed("autoencoder", model.autoencoder) | _prefixed("node", model.node)
    _write(folder, tensors, card)


def load_forecast_model(folder: str | Path) -> ForecastModel:
    """Read what `save_forecast_model` wrote; raises InputError for anything else."""
    card, tensors = _read(folder, "forecast model")
    with _Rebuilding(folder):
        settings, weights = card["neural_ode"], _under("node", tensors)
        scales = weights["latent_scale"], weights["rate_scale"]
        node = NeuralOde(tuple(settings["hidden"]), 0.0, *scales, settings["seed"])
        node.load_state_dict(weights)
        autoencoder = _rebuild_autoencoder(card, tensors)
        return ForecastModel(autoencoder, node, settings["rtol"], settings["atol"])


def _autoencoder_card(model: Autoencoder) -> dict[str, Any]:
    return {
        "variant": model.variant,
        "latent_dim": model.latent_dim,
        "seed": model.seed,
        "scales": asdict(model.scales),
        "settings": asdict(model.settings),
    }


def _rebuild_autoencoder(card: dict[str, Any], tensors: dict[str, Tensor]) -> Autoencoder:
    facts, weights = card["autoencoder"], _under("autoencoder", tensors)
    settings = facts["settings"] | {"decoder_hidden": tuple(facts["settings"]["decoder_hidden"])}
    n_odd = int((weights["decoder.signs_out"] < 0).sum())
    basis = ModalBasis(weights["modes"].numpy(), n_odd, weights["scale"].numpy().astype(float) ** 2)
    model = Autoencoder(
        facts["variant"],
        facts["latent_dim"],
        basis,
        Scales(**facts["scales"]),
        AutoencoderSettings(**settings),
        facts["seed"],
    )
    model.load_state_dict(weights)
    return model


def _prefixed(prefix: str, model: Autoencoder | NeuralOde) -> dict[str, Tensor]:
    return {f"{prefix}.{name}": value.contiguous() for name, value in model.state_dict().items()}


def _under(prefix: str, tensors: dict[str, Tensor]) -> dict[str, Tensor]:
    start = f"{prefix}."
    return {name[len(start) :]: value for name, value in tensors.items() if name.startswith(start)}


def _write(folder: str | Path, tensors: dict[str, Tensor], card: dict[str, Any]) -> None:
    _require_finite(tensors)
    weights = save_tensors(tensors)
    card = {**card, "sha256": sha256_of_bytes(weights)}
    text = json.dumps(card, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
    require_folder(Path(folder))
    write_bytes(Path(folder) / WEIGHTS, weights)
    write_bytes(Path(folder) / CARD, text.encode())


def _require_finite(tensors: dict[str, Tensor]) -> None:
    for name, value in tensors.items():
        if not torch.isfinite(value).all():
            raise NumericalError(
                f"the model's {name} is not finite, so it is not written; "
                "train again with a smaller learning rate or another seed"
            )


def _read(folder: str | Path, kind: str) -> tuple[dict[str, Any], dict[str, Tensor]]:
    card, weights = read_model_folder(folder, kind)
    with _Rebuilding(folder):
        return card, load_tensors(weights)


class _Rebuilding:
    """Turns what a card with missing or strange entries causes into one InputError."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = folder

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: type | None, error: BaseException | None, trace: object) -> None:
        if isinstance(error, (KeyError, TypeError, ValueError, RuntimeError, SafetensorError)):
            raise does_not_fit(self.folder, error) from error
