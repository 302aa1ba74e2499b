"""Which rows of the table of choices the decision chart shows, and how each family looks."""

from dataclasses import dataclass

import pandas as pd

from sedfiber.figures.style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION
from sedfiber.figures.table_input import select_columns

SIMULATION, FORECAST, LOOKUP, GALERKIN = "simulation", "forecast", "lookup", "POD-Galerkin"
TORCH = " (torch)"
BATCHES = "osD^vP"  # a marker for each size, from one forecast alone up
_MODELS = (SKY, BLUE, GREEN, VERMILION, GREY)  # in order of d
_NUMBERS = (
    "dimension tolerance batch error_worst error_median seconds_least preparation_seconds times_faster"
    " break_even_queries"
)
_NEAR = 1.1  # times a model's least error, where a looser tolerance is as good
_BEYOND = 3.0  # times the largest error: where infinite ones are drawn


@dataclass(frozen=True)
class Choices:
    """The rows that are drawn; ``edge`` is where infinite errors are, ``colors`` are by name of a model."""

    rows: pd.DataFrame
    edge: float
    colors: dict[str, str]

    def family(self, name: str) -> pd.DataFrame:
        """The rows of one family; forecasts are those of compiled code."""
        own = self.rows[self.rows["family"] == name]
        return own[~own["name"].str.endswith(TORCH)]

    @property
    def torch(self) -> pd.DataFrame:
        """Forecasts that are not of compiled code."""
        return self.rows[self.rows["name"].str.endswith(TORCH)]

    @property
    def batches(self) -> list[float]:
        """Sizes of all sweeps."""
        return sorted(self.family(FORECAST)["batch"].unique())


def choices(table: pd.DataFrame) -> Choices:
    """Checked; of each model one tolerance, ``worst`` and ``median`` with the edge for infinity.

    Raises InputError when a column is missing.
    """
    rows = select_columns(table, ("family", "name", "precision"), _NUMBERS.split())
    rows = rows.assign(pays=table["break_even_queries"].astype(float), simple=rows["name"].str.removesuffix(TORCH))
    edge = _BEYOND * rows["error_worst"].max() if rows["error_worst"].notna().any() else 1.0
    rows = rows.assign(worst=rows["error_worst"].fillna(edge), median=rows["error_median"].fillna(edge))
    compiled = (rows["family"] == FORECAST) & ~rows["name"].str.endswith(TORCH)
    kept = [_at_one_tolerance(own) for _, own in rows[compiled].groupby("name", sort=False)]
    forecasts = rows[rows["family"] == FORECAST].sort_values("dimension", kind="stable")
    colors = {name: _MODELS[i % len(_MODELS)] for i, name in enumerate(forecasts["simple"].unique())}
    return Choices(pd.concat([rows[~compiled], *kept]), edge, colors)


def color_of(shown: Choices, family: str, name: str) -> str:
    """The color of a choice in every panel."""
    if family == FORECAST:
        return shown.colors[name]
    return {SIMULATION: BLACK, LOOKUP: ORANGE, GALERKIN: PURPLE}.get(family, GREY)


def _at_one_tolerance(model: pd.DataFrame) -> pd.DataFrame:
    """The loosest at which the largest error is nearly the model's least, of those with most sizes of batches."""
    tried = model.groupby("tolerance").size()
    model = model[model["tolerance"].isin(tried[tried == tried.max()].index)]
    alone = model[model["batch"] == model["batch"].min()]
    worst = alone.groupby("tolerance")["worst"].max()
    return model[model["tolerance"] == worst[worst <= _NEAR * worst.min()].index.max()]
