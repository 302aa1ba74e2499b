"""A model's folder: ``model.safetensors`` (weights) and ``card.json`` (what they are), read and checked.

The card holds the checksum of the weights, so that a half-finished write is never taken for a
model.  Neither torch nor NumPy is needed here: the caller turns the bytes into tensors.
"""

import json
from pathlib import Path
from typing import Any

from sedfiber.core.checksum import sha256_of_bytes
from sedfiber.core.errors import InputError

WEIGHTS = "model.safetensors"
CARD = "card.json"
SHIPPED = Path(__file__).parent / "shipped"  # the forecast model that comes with the package


def read_model_folder(folder: str | Path, kind: str) -> tuple[dict[str, Any], bytes]:
    """Card and weights of a model of that kind, such as ``forecast model``; raises InputError for anything else."""
    try:
        card = json.loads((Path(folder) / CARD).read_text(encoding="utf-8"))
        weights = (Path(folder) / WEIGHTS).read_bytes()
    except OSError as error:
        name = Path(error.filename).name
        raise InputError(f"model: {folder} holds no readable model ({name}: {error.strerror})") from error
    except ValueError as error:
        raise InputError(f"model: {folder} holds no readable model ({CARD}: {error})") from error
    if not isinstance(card, dict) or card.get("kind") != kind:
        raise InputError(f"{folder} does not hold a model of the kind {kind!r}")
    if card.get("sha256") != sha256_of_bytes(weights):
        raise InputError(f"{folder}/{WEIGHTS} does not match its card: damaged or half-written")
    return card, weights


def does_not_fit(folder: str | Path, error: Exception) -> InputError:
    """The error for a card whose entries are missing, or do not fit the weights."""
    return InputError(f"{folder} holds a model that does not fit: {str(error).splitlines()[0]}")
