"""A table as one HTML page that needs nothing else: no script, no font and no file from outside."""

import html
import math
from collections.abc import Sequence

import pandas as pd

_STYLE = """
body { font: 14px/1.4 system-ui, sans-serif; margin: 1.5em; color: #222; background: #fff; }
table { border-collapse: collapse; }
th { position: sticky; top: 0; background: #f2f2f2; text-align: left; }
th, td { padding: 0.25em 0.8em; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
p { color: #555; }
"""
_DIGITS = 4  # significant; the CSV file has all of them


def table_page(table: pd.DataFrame, title: str, note: str, most_rows: int) -> str:
    """A page with the first ``most_rows`` rows, numbers to four digits, and a line that says what is left out."""
    words = [note] if note else []
    if len(table) > most_rows:
        words.append(f"The first {most_rows} of {len(table)} rows.")
    head = "".join(f"<th>{html.escape(str(name))}</th>" for name in table.columns)
    rows = "\n".join(_row(values) for values in table.head(most_rows).itertuples(index=False))
    body = f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>"
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8"><title>{html.escape(title)}</title>'
        f"<style>{_STYLE}</style></head>\n<body>\n<h1>{html.escape(title)}</h1>\n"
        f"<p>{html.escape(' '.join(words))}</p>\n{body}\n</body>\n</html>\n"
    )


def _row(values: Sequence) -> str:
    return "<tr>" + "".join(_cell(value) for value in values) + "</tr>"


def _cell(value: object) -> str:
    if isinstance(value, float):  # a missing word, too, is NaN
        return f'<td class="number">{_number(value)}</td>'
    if isinstance(value, int) and not isinstance(value, bool):
        return f'<td class="number">{value}</td>'
    return f"<td>{html.escape(str(value))}</td>"


def _number(value: float) -> str:
    """Whole numbers as they are, others to four digits; nothing for a missing one."""
    if math.isnan(value):
        return ""
    if value.is_integer() and abs(value) < 1e6:
        return str(int(value))
    return f"{value:.{_DIGITS}g}"
