"""A table as a page: every row and column there, nothing from outside, foreign text harmless."""

from html.parser import HTMLParser

import pandas as pd
import pytest

from command_line import run_step
from sedfiber.commands.steps import show_manifest, show_table
from sedfiber.core.errors import InputError
from sedfiber.figures.html_page import table_page


class Cells(HTMLParser):
    """The text of every cell, row by row, and every tag with its attributes."""

    def __init__(self, page: str):
        super().__init__()
        self.rows, self.tags, self._in_cell = [], [], False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
            self._in_cell = True

    def handle_endtag(self, tag):
        self._in_cell = self._in_cell and tag not in ("td", "th")

    def handle_data(self, data):
        if self._in_cell:
            self.rows[-1][-1] += data


TABLE = pd.DataFrame({"B": [100.0, 150.0], "k": [3, 5], "E": [1.23456e-5, None], "word": ["<b>a & b</b>", "c"]})


def test_every_cell_is_on_the_page_numbers_to_four_digits():
    """Whole numbers as they are; a missing one is empty."""
    page = Cells(table_page(TABLE, "title", "note", most_rows=10))
    assert page.rows == [["B", "k", "E", "word"], ["100", "3", "1.235e-05", "<b>a & b</b>"], ["150", "5", "", "c"]]


def test_nothing_on_the_page_comes_from_elsewhere():
    """No script, no link, no picture: the report has to work offline."""
    tags = Cells(table_page(TABLE, "<script>", "note", most_rows=10)).tags
    assert {"script", "link", "img", "b"}.isdisjoint(tag for tag, _ in tags)
    assert not any("src" in attrs or "href" in attrs for _, attrs in tags)


def test_a_long_table_says_what_is_left_out():
    """The first rows, and how many there are."""
    page = table_page(TABLE, "title", "", most_rows=1)
    assert "The first 1 of 2 rows." in page
    assert len(Cells(page).rows) == 2


def test_show_table_names_the_file_with_all_digits(tmp_path):
    """The page is a view; the CSV file is the result."""
    TABLE.to_csv(tmp_path / "some_table.csv", index=False)
    run_step(show_table, tmp_path / "some_table.csv", "-o", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert "<title>some table</title>" in page and f"{tmp_path}/some_table.csv" in page


def test_show_manifest_refuses_what_is_none(tmp_path):
    """One line that names the file."""
    (tmp_path / "manifest.json").write_text("not JSON")
    with pytest.raises(InputError, match="cannot read the manifest"):
        run_step(show_manifest, tmp_path / "manifest.json", "-o", tmp_path / "page.html")
    assert not (tmp_path / "page.html").exists()
