"""Reading a trained model's file without torch; see `learning.model_files` for how it is written."""

import hashlib
import json
from pathlib import Path
from typing import Any

from safetensors import SafetensorError
from safetensors.numpy import load as load_tensors

from sedfiber.compiled.tables import Tensors
from sedfiber.errors import InputError

KIND = "forecast model"


def read_model(folder: str | Path) -> tuple[Tensors, dict[str, Any]]:
    """Weights and card of a forecast model; raises InputError for anything else."""
    try:
        card = json.loads((Path(folder) / "card.json").read_text(encoding="utf-8"))
        weights = (Path(folder) / "model.safetensors").read_bytes()
    except (OSError, ValueError) as error:
        raise InputError(f"{folder} holds no readable model: {error}") from error
    if not isinstance(card, dict) or card.get("kind") != KIND:
        raise InputError(f"{folder} does not hold a model of the kind {KIND!r}")
    if card.get("sha256") != hashlib.sha256(weights).hexdigest():
        raise InputError(f"{folder}/model.safetensors does not match its card: damaged or half-written")
    try:
        return load_tensors(weights), card
    except (SafetensorError, ValueError) as error:
        raise does_not_fit(folder, error) from error


def does_not_fit(folder: str | Path, error: Exception) -> InputError:
    """What to raise for a card whose entries are missing, or do not fit the weights."""
    return InputError(f"{folder} holds a model that does not fit: {str(error).splitlines()[0]}")
