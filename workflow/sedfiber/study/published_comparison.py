"""A fresh run's numbers against the published ones, each within a stated tolerance.

What is simulated must agree to the digits that an integrator leaves; what is trained may differ as
much as trainings do whose data differ in the last bits (measured on runs of the whole study: losses
of autoencoders within a factor of 3.1, largest errors of a model's forecasts within 70).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from sedfiber.core.array_types import Array
from sedfiber.core.errors import InputError

Rows = Callable[[pd.DataFrame], pd.Series]


def _all(table: pd.DataFrame) -> pd.Series:
    return pd.Series(True, table.index)


def _is(column: str, *values: str) -> Rows:
    return lambda table: table[column].isin(values)


def _starts(column: str, *starts: str) -> Rows:
    return lambda table: table[column].str.startswith(starts)


@dataclass(frozen=True)
class Compared:
    """One column of a table; rows are paired by ``keys``; ``factor`` is what numbers may differ by, 1 means equal."""

    table: str
    column: str
    keys: tuple[str, ...]
    factor: float
    what: str
    rows: Rows = _all


_FALL = ("B", "angle_index")
_LOSS = ("method", "variant", "seed", "latent_dim", "test_set")
COMPARED = (
    Compared("trajectories", "settled_to", _FALL, 1.0, "what each fall settles to"),
    Compared("trajectories", "settling_time", _FALL, 1 + 1e-5, "settling times"),
    Compared("regimes", "regime", _FALL, 1.0, "the regime of each fall"),
    Compared("audit", "matters", ("run", "effect"), 1.0, "whether what was left out matters"),
    Compared("reconstruction", "loss", _LOSS, 1 + 1e-4, "losses of POD", _is("method", "pod")),
    Compared("reconstruction", "loss", _LOSS, 10.0, "losses of autoencoders", _is("method", "autoencoder")),
    Compared("baselines", "E_worst", ("test_set", "B", "model"), 1.1, "errors of the lookup", _is("recipe", "lookup")),
    Compared("key_numbers", "met", ("key",), 1.0, "which bars are met"),
    Compared(
        "key_numbers", "this_run", ("key",), 100.0, "largest errors of models", _starts("key", "ensemble", "worst")
    ),
)


def compare(name: str, published: pd.DataFrame, fresh: pd.DataFrame) -> pd.DataFrame:
    """One row for each comparison of that table: rows compared, largest factor between them, tolerance, within or not.

    Raises InputError when a row is in one of the two tables only.
    """
    return pd.DataFrame([_row(one, published, fresh) for one in COMPARED if one.table == name])


def _row(one: Compared, published: pd.DataFrame, fresh: pd.DataFrame) -> dict:
    ours, theirs = (_values(one, table) for table in (fresh, published))
    if set(ours.index) != set(theirs.index):
        odd = sorted(set(ours.index) ^ set(theirs.index), key=str)[0]
        raise InputError(f"compare: {one.table}.csv: the row {odd} of {one.what} is in one of the two runs only")
    ours = ours.loc[theirs.index]
    apart = _factors(ours.to_numpy(), theirs.to_numpy()) if one.factor > 1.0 else _unequal(ours, theirs)
    worst = int(np.argmax(apart))
    return {
        "table": one.table,
        "what": one.what,
        "rows": len(ours),
        "largest_factor": float(apart[worst]),
        "allowed_factor": one.factor,
        "where": _words(ours.index[worst]),
        "within": bool(apart[worst] <= one.factor),
    }


def _words(keys: tuple) -> str:
    return " ".join(f"{key:g}" if isinstance(key, float) else str(key) for key in keys)


def _values(one: Compared, table: pd.DataFrame) -> pd.Series:
    chosen = table[one.rows(table)]
    keys = chosen[list(one.keys)].astype(object).where(chosen[list(one.keys)].notna(), "")
    return pd.Series(chosen[one.column].to_numpy(), index=[tuple(row) for row in keys.to_numpy()])


def _factors(ours: Array, theirs: Array) -> Array:
    """The ratio of the larger to the smaller of each pair; infinite where one is not a number."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.maximum(ours / theirs, theirs / ours)
    return np.where(ours == theirs, 1.0, np.nan_to_num(ratio, nan=np.inf))


def _unequal(ours: pd.Series, theirs: pd.Series) -> Array:
    """1 where two words are equal, infinite where not."""
    same = (ours.fillna("").astype(str) == theirs.fillna("").astype(str)).to_numpy()
    return np.where(same, 1.0, np.inf)
