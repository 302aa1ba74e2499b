"""Advice on the choice for an accuracy, with its cost, from the tables of ``snakemake cost``.

Between two measured ℬ the larger error and the longer time of the two count; times are scaled by
how long a right-hand side takes on this machine.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import pandas as pd

from sedfiber.study.costs.choice import FORECAST, LOOKUP, SIMULATION

BETTER = 0.1  # of an error: what is called better accuracy
_KEYS = ["family", "name", "tolerance", "batch", "precision"]


@dataclass(frozen=True)
class Offer:
    """A choice at one ℬ: its largest error over L, seconds of a trajectory, and seconds before the first."""

    family: str
    name: str
    tolerance: float
    batch: int
    precision: str
    error: float
    seconds: float
    preparation: float

    def total(self, queries: int, trained: bool) -> float:
        """Seconds of so many trajectories; what was trained already costs nothing more."""
        return queries * self.seconds + (0.0 if trained else self.preparation)

    @property
    def words(self) -> str:
        """The choice in words."""
        if self.family == LOOKUP:
            return "spline lookup in the training set"
        together = "" if self.batch == 1 else f", {self.batch} at once in {self.precision}"
        return f"{self.family} by {self.name} at tolerance {self.tolerance:g}{together}"


@dataclass(frozen=True)
class Question:
    """ℬ, the largest error that is allowed (root-mean-square bead distance over L), and how many trajectories."""

    B: float
    error: float
    queries: int


def advice(question: Question, choices: pd.DataFrame, discretisation: pd.DataFrame, scale: float) -> list[str]:
    """Lines of advice; ``scale`` is the time of a right-hand side here over that in the tables."""
    offers = _offers(question, choices, scale)
    lines = [f"B = {question.B:g}, error up to {question.error:g} L, trajectories: {question.queries}"]
    lines += _outside(question, choices)
    fitting = [offer for offer in offers if offer.error <= question.error]
    if not fitting:
        best = min(offers, key=lambda offer: offer.error)
        return [*lines, f"nothing that was measured reaches it; the most accurate: {_facts(best, question)}"]
    chosen = _cheapest(fitting, question, trained=True)
    lines.append(f"choose {_facts(chosen, question)}")
    lines += _training(chosen, fitting, question) if chosen.preparation else _models(offers, question)
    return [*lines, *_better(chosen, offers, question), *_beads(question, discretisation), _machine(scale)]


def _offers(question: Question, choices: pd.DataFrame, scale: float) -> list[Offer]:
    """All choices at the question's ℬ whose batches it fills."""
    allowed = choices[choices["family"].isin([SIMULATION, FORECAST, LOOKUP]) & (choices["batch"] <= question.queries)]
    near = allowed[allowed["B"].isin(_neighbours(question.B, allowed["B"].unique()))]
    grouped = near.groupby(_KEYS, dropna=False, sort=False)
    largest = grouped[["error_worst", "seconds_median", "preparation_seconds"]].max().reset_index()
    largest[["seconds_median", "preparation_seconds"]] *= scale
    rows: Iterable[Any] = largest.itertuples(index=False, name=None)
    return [Offer(*row) for row in rows]


def _neighbours(B: float, measured: Iterable[float]) -> list[float]:
    """The measured ℬ on both sides, or the nearest end."""
    values = sorted(measured)
    below, above = [x for x in values if x <= B], [x for x in values if x >= B]
    return [*below[-1:], *above[:1]]


def _outside(question: Question, choices: pd.DataFrame) -> list[str]:
    low, high = choices["B"].min(), choices["B"].max()
    if low <= question.B <= high:
        return []
    return [f"B lies outside what was measured, {low:g} to {high:g}: what follows is true of the nearer end"]


def _training(chosen: Offer, fitting: list[Offer], question: Question) -> list[str]:
    """Words on the training of the choice, and the number of trajectories that earns it back."""
    untrained = _cheapest(fitting, question, trained=False)
    lines = [f"training it first takes {_duration(chosen.preparation)} more"]
    simulations = [offer for offer in fitting if offer.family == SIMULATION]
    if simulations:
        fastest = min(simulations, key=lambda offer: offer.seconds)
        even = chosen.preparation / (fastest.seconds - chosen.seconds)
        lines[0] += f", earned back after {even:.2g} trajectories"
    if untrained is not chosen:
        lines.append(f"without a trained model: {_facts(untrained, question)}")
    return lines


def _models(offers: list[Offer], question: Question) -> list[str]:
    """Words on why no model is chosen: none is accurate enough, or none is faster."""
    models = [offer for offer in offers if offer.family == FORECAST]
    if not models:
        return []
    best = min(models, key=lambda offer: (offer.error > question.error, offer.error, offer.seconds))
    why = "no model is accurate enough" if best.error > question.error else "no model is faster"
    return [f"{why}; the most accurate: {_facts(best, question)}"]


def _better(chosen: Offer, offers: list[Offer], question: Question) -> list[str]:
    """Words on the cost of a tenth of the error."""
    better = [offer for offer in offers if offer.error <= BETTER * question.error]
    if not better:
        return [f"a tenth of the error is beyond what was measured at B = {question.B:g}"]
    next_one = _cheapest(better, question, trained=True)
    return [f"a tenth of the error costs {next_one.seconds / chosen.seconds:.2g} times as much: {next_one.words}"]


def _beads(question: Question, discretisation: pd.DataFrame) -> list[str]:
    """How many beads it takes for the terminal shape to differ by no more from that of the most beads."""
    table = discretisation[(discretisation["hydrodynamics"] == "RPY") & (discretisation["status"] == "ok")]
    off = table.set_index("n_beads")["shape_from_finest_L"].sort_index()
    finest = off.index[-1]
    enough = [n for n in off.index[:-1] if off[n] <= question.error]
    beads = f"from {enough[0]} beads on" if enough else f"not below {finest} beads"
    words = f"these errors are against the same beads; against a chain of {finest} (B = {table['B'].iloc[0]:g})"
    return [f"{words} the terminal shape is right to {question.error:g} L {beads}"]


def _machine(scale: float) -> str:
    return f"times are this machine's, where a right-hand side takes {scale:.2f} times as long as in the tables"


def _cheapest(offers: list[Offer], question: Question, trained: bool) -> Offer:
    return min(offers, key=lambda offer: offer.total(question.queries, trained))


def _facts(offer: Offer, question: Question) -> str:
    """The choice with its error and time."""
    many = "" if question.queries == 1 else f", {_duration(question.queries * offer.seconds)} in all"
    return f"{offer.words}: error up to {offer.error:.1e} L, {_duration(offer.seconds)} a trajectory{many}"


def _duration(seconds: float) -> str:
    """Seconds in a unit that suits them."""
    for unit, size in (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e6:.3g} µs"
