"""A short note of the measurements that a figure of costs leaves out."""

from collections import defaultdict
from collections.abc import Mapping

import pandas as pd

_LONGEST = 60  # letters of a reason
_FOLLOWS = "not tried"  # from the row before, which says why


def left_out(panels: Mapping[str, pd.DataFrame]) -> list[str]:
    """One line: each reason with methods, tolerances and panels, out of rows whose status is not "ok"."""
    groups: dict[tuple[str, str], dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for letter, rows in panels.items():
        for (reason, method), own in _omitted(rows).groupby(["status", "label"], sort=False):
            groups[reason, _tolerances(own)][method].append(letter)
    texts = [f"{_short(reason)}{at}: {_methods(found)}" for (reason, at), found in groups.items()]
    return [f"Not shown: {'; '.join(texts)}."] if texts else []


def _omitted(rows: pd.DataFrame) -> pd.DataFrame:
    left = rows[(rows["status"] != "ok") & ~rows["status"].str.startswith(_FOLLOWS)]
    suffix = left["jacobian"].map({"differences": " by differences"}).fillna("")
    return left.assign(label=left["method"] + suffix)


def _tolerances(rows: pd.DataFrame) -> str:
    """The tolerances of the rows. Where a run takes too long, tighter ones are not tried."""
    named = ", ".join(f"{tolerance:.0e}".replace("e-0", "e-") for tolerance in sorted(rows["tolerance"], reverse=True))
    tighter = " and tighter" if rows["status"].str.startswith("takes longer").all() else ""
    return f" at {named}{tighter}"


def _methods(found: Mapping[str, list[str]]) -> str:
    """Methods of the same panels together: "DOP853, RK45 in a, d"."""
    together = defaultdict(list)
    for method, letters in found.items():
        together[", ".join(letters)].append(method)
    return "; ".join(f"{', '.join(methods)} in {letters}" for letters, methods in together.items())


def _short(reason: str) -> str:
    return reason if len(reason) <= _LONGEST else f"{reason[:_LONGEST].rsplit(' ', 1)[0]} …"
