"""The words of ``sedfiber draw``, as the rules of the workflow call it."""

import json
from pathlib import Path


def draw_words(figure: str, folder: Path, inputs: dict, options: dict | None = None) -> list[str]:
    """Draw a figure into ``folder`` as x.svg and x.png; inputs are paths or lists of them."""
    settings = json.dumps({"inputs": inputs, "options": options or {}}, default=str)
    return ["draw", figure, "--settings", settings, "--svg", str(folder / "x.svg"), "--png", str(folder / "x.png")]
