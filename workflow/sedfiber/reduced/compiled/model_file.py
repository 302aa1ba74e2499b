"""Reading a trained model's file without torch; see `learning.model_files` for how it is written."""

from pathlib import Path
from typing import Any

from safetensors import SafetensorError
from safetensors.numpy import load as load_tensors

from sedfiber.reduced.compiled.tables import Tensors
from sedfiber.reduced.model_folder import does_not_fit, read_model_folder


def read_model(folder: str | Path) -> tuple[Tensors, dict[str, Any]]:
    """Weights and card of a forecast model; raises InputError for anything else."""
    card, weights = read_model_folder(folder, "forecast model")
    try:
        return load_tensors(weights), card
    except (SafetensorError, ValueError) as error:
        raise does_not_fit(folder, error) from error
