"""Names and markers of the models, alike in every figure that compares them."""

import math
from collections import Counter
from typing import NamedTuple

import pandas as pd

from sedfiber.core.errors import InputError
from sedfiber.core.validation import one_of
from sedfiber.figures.style import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION

NAMES = {"rollout": "this study", "source": "paper's recipe", "lookup": "lookup, no model"}

# colour and marker of each recipe's models, in order of d
LOOKS = {
    "rollout": ((SKY, "o"), (BLUE, "s"), (BLACK, "D"), (GREEN, "P")),
    "source": ((VERMILION, "^"), (PURPLE, ">")),
    "lookup": ((ORANGE, "v"),),
}


class LegendEntry(NamedTuple):
    """One entry of a legend; ``model`` is its name in the tables."""

    model: str
    recipe: str
    label: str
    color: str
    marker: str


def legend_entries(table: pd.DataFrame) -> list[LegendEntry]:
    """Every model of a table with columns model, recipe and latent_dim: ours by d, the paper's, the lookup.

    Raises InputError for an unknown recipe, or for more models of one recipe than there are markers.
    """
    rows = [(recipe, d, model) for model, recipe, d in _models(table)]
    rows.sort(key=lambda row: (list(NAMES).index(row[0]), row[1], row[2]))
    used: Counter[str] = Counter()
    found = []
    for recipe, latent_dim, model in rows:
        color, marker = _look(recipe, used[recipe])
        used[recipe] += 1
        found.append(LegendEntry(model, recipe, _label(recipe, latent_dim), color, marker))
    return found


def _models(table: pd.DataFrame) -> list[tuple[str, str, float]]:
    columns = table[["model", "recipe", "latent_dim"]].drop_duplicates()
    return [(model, one_of("recipe", recipe, NAMES), d) for model, recipe, d in columns.itertuples(index=False)]


def _look(recipe: str, index: int) -> tuple[str, str]:
    if index >= len(LOOKS[recipe]):
        raise InputError(f"input: recipe {recipe} has more than {len(LOOKS[recipe])} models, too many to tell apart")
    return LOOKS[recipe][index]


def _label(recipe: str, latent_dim: float) -> str:
    return NAMES[recipe] if math.isnan(latent_dim) else f"{NAMES[recipe]}, d = {latent_dim:g}"
