"""CSV tables: written whole or not at all, floats with all their digits."""

from pathlib import Path

import pandas as pd

from sedfiber.core.atomic_file import write_text
from sedfiber.core.errors import InputError


def write_csv(table: pd.DataFrame, path: Path) -> None:
    """Write without an index; the same table gives the same bytes."""
    write_text(path, table.to_csv(index=False, lineterminator="\n"))


def read_csv(path: Path) -> pd.DataFrame:
    """Read a table; raises InputError when it is missing or not CSV."""
    try:
        return pd.read_csv(path)
    except (OSError, ValueError) as error:
        raise InputError(f"input: cannot read the table {str(path)!r} ({str(error).splitlines()[0]})") from None
