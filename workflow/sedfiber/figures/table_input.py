"""The part of a table that a figure needs, checked."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from sedfiber.core.errors import InputError

TEST_SETS = ("A", "B")


def select_columns(table: pd.DataFrame, text: Sequence[str], numbers: Sequence[str]) -> pd.DataFrame:
    """The named columns; empty text is ``""``, empty and infinite numbers (a diverged forecast) are NaN.

    Raises InputError when a column is missing, holds text for numbers, or there is no row.
    """
    _require_columns(table, (*text, *numbers))
    words = {name: table[name].fillna("").astype(str) for name in text}
    values = {name: _as_numbers(table[name]) for name in numbers}
    return pd.DataFrame(words | values)


def in_set(table: pd.DataFrame, test_set: str) -> pd.DataFrame:
    """The rows of one test set."""
    return table[table["test_set"] == test_set]


def _require_columns(table: pd.DataFrame, names: Sequence[str]) -> None:
    missing = [name for name in names if name not in table]
    if missing:
        raise InputError(f"input: the table has no column {', '.join(missing)}; it has {', '.join(table.columns)}")
    if table.empty:
        raise InputError("input: the table has no rows")
    strangers = sorted(set(table["test_set"].astype(str)) - set(TEST_SETS)) if "test_set" in names else []
    if strangers:
        raise InputError(f"input: test_set: {strangers[0]!r} is not allowed; give one of {', '.join(TEST_SETS)}")


def _as_numbers(column: pd.Series) -> pd.Series:
    try:
        return pd.to_numeric(column).astype(float).replace([np.inf, -np.inf], np.nan)
    except (ValueError, TypeError) as error:
        raise InputError(f"input: column {column.name} must hold numbers ({error})") from None
