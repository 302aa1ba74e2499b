"""Tables of choices: at each ℬ for advice, and over all test trajectories for the chart and the bars."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from sedfiber.core.array_types import Array
from sedfiber.study.costs.choice import FORECAST, SIMULATION, TORCH, Outcome, Outcomes
from sedfiber.study.costs.queries import Query

SECONDS = ("seconds_least", "seconds_median", "seconds_spread")
COUNTS = ("rhs", "steps", "jacobians", "factorisations", "evaluations", "decoded", "rhs_units", "repeats")
SINGLE_BAR, SWEEP_BAR, SWEEP = 10.0, 300.0, 1000  # times faster than a simulation, and for how many at once


def choices_at_each_B(
    found: Outcomes, asked: Sequence[Query], preparation: Mapping[str, float], data: float
) -> pd.DataFrame:
    """One row a choice and ℬ: largest and median error over the angles, median seconds of a trajectory."""
    values = np.array([query.B for query in asked])
    whole = [outcome for outcome in found.all() if len(outcome.rows) == len(asked)]
    return pd.DataFrame(
        [
            outcome.facts
            | {"B": B, "queries": int((values == B).sum())}
            | _errors(outcome, values == B)
            | _medians(outcome, values == B, SECONDS)
            | {"preparation_seconds": _preparation(outcome, preparation, data)}
            for outcome in whole
            for B in np.unique(values)
        ]
    )


def choices_overall(found: Outcomes, preparation: Mapping[str, float], data: float) -> pd.DataFrame:
    """One row a choice, over all queries; for forecasts with the simulation that is as wrong beside it.

    ``simulation_seconds`` is the median of the fastest simulations at the forecast's own error,
    trajectory by trajectory; ``times_faster`` the median and ``times_faster_least`` the least of their
    ratios.  ``preparation_seconds`` are those of data and training, ``break_even_queries`` the number
    of queries from which they are earned back.
    """
    return pd.DataFrame([_overall(outcome, found, _preparation(outcome, preparation, data)) for outcome in found.all()])


def fastest_simulation(found: Outcomes, errors: Array) -> Array:
    """Seconds of the fastest simulation that is no further off on the same query, (R,); of the best where none is."""
    ladder = found.family(SIMULATION)
    wrong = np.array([outcome.column("error") for outcome in ladder])
    seconds = np.array([outcome.column("seconds_least") for outcome in ladder])
    fitting = np.where(wrong <= errors, seconds, np.inf)
    tightest = seconds[np.argmin(wrong, axis=0), np.arange(wrong.shape[1])]
    best = fitting.min(axis=0)
    return np.where(np.isfinite(best), best, tightest)


def _overall(outcome: Outcome, found: Outcomes, preparation: float) -> dict:
    everywhere = np.ones(len(outcome.rows), dtype=bool)
    row = outcome.facts | {"queries": len(outcome.rows), "failed": len(outcome.failures)}
    row |= _errors(outcome, everywhere) | _medians(outcome, everywhere, (*SECONDS, *COUNTS))
    row |= {"preparation_seconds": preparation}
    comparable = outcome.choice.family != SIMULATION and len(outcome.rows) == len(found.family(SIMULATION)[0].rows)
    return row | (_against_simulation(outcome, found, preparation) if comparable else {})


def _preparation(outcome: Outcome, preparation: Mapping[str, float], data: float) -> float:
    """Seconds before the first answer: none for a simulation, those of the data for what learns nothing else."""
    return (
        0.0 if outcome.choice.family == SIMULATION else preparation.get(outcome.choice.name.removesuffix(TORCH), data)
    )


def _against_simulation(outcome: Outcome, found: Outcomes, preparation: float) -> dict:
    simulated, own = fastest_simulation(found, outcome.column("error")), outcome.column("seconds_least")
    answered = np.isfinite(own)
    if not answered.any():
        return {}
    ratios, saved = (simulated / own)[answered], float((simulated - own)[answered].mean())
    return {
        "simulation_seconds": float(np.median(simulated[answered])),
        "times_faster": float(np.median(ratios)),
        "times_faster_least": float(ratios.min()),
        "times_faster_bar": _bar(outcome),
        "break_even_queries": preparation / saved if saved > 0 else np.inf,
    }


def _bar(outcome: Outcome) -> float:
    choice = outcome.choice
    if choice.family != FORECAST:
        return float("nan")
    return {1: SINGLE_BAR, SWEEP: SWEEP_BAR}.get(choice.batch, float("nan"))


def _errors(outcome: Outcome, at: Array) -> dict[str, float]:
    error, E = outcome.column("error")[at], outcome.column("E")[at]
    return {"error_worst": error.max(), "error_median": np.median(error), "E_worst": E.max(), "E_median": np.median(E)}


def _medians(outcome: Outcome, at: Array, names: Sequence[str]) -> dict[str, float]:
    columns = {name: outcome.column(name)[at] for name in names}
    return {name: float(np.nanmedian(x)) if np.isfinite(x).any() else np.nan for name, x in columns.items()}
