"""The report of a finished study, opened in a real browser as a reader would, offline."""

import csv
import re

import pytest
import yaml
from browser import opened_page
from workflow_helpers import REPOSITORY

pytestmark = pytest.mark.slow

FIGURES = yaml.safe_load((REPOSITORY / "workflow/report/figures.yaml").read_text(encoding="utf-8"))
IN_ALL = {name for name, about in FIGURES.items() if about["part"] == "study"}


@pytest.fixture(scope="module")
def report(finished):
    """The page, made as the README says."""
    run = finished.snakemake("--report", "report.html")
    assert run.returncode == 0, run.stdout + run.stderr
    return finished.folder / "report.html"


@pytest.fixture(scope="module")
def page(report):
    """The page in the browser; nothing has been clicked."""
    with opened_page() as page:
        page.goto(report.as_uri())
        page.wait_for_selector("text=Statistics")
        yield page


def listed(page) -> dict[str, dict]:
    """What the page holds: path, kind, caption and category of every figure and table."""
    return page.evaluate(
        "() => { const found = {};"
        "for (const [category, groups] of Object.entries(categories))"
        " for (const path of Object.values(groups).flat())"
        "  found[path] = {category, kind: results[path].mime_type, caption: results[path].caption};"
        "return found; }"
    )


def open_every(page, category: str):
    """Click through a category, entry by entry; the contents appear beside the list."""
    page.goto(page.url.split("#")[0])
    page.click(f"text={category}")
    page.wait_for_selector("[role=group]")
    for eye in page.query_selector_all("[role=group] a:first-child"):
        eye.click()
        yield page


def test_every_figure_and_table_is_there_with_a_caption(page, finished):
    """Figures of the study as SVG, all its tables as pages, and where they come from."""
    found = listed(page)
    figures = {path for path, about in found.items() if about["kind"] == "image/svg+xml"}
    assert figures == {f"results/figures/{name}.svg" for name in IN_ALL}
    pages = {path for path, about in found.items() if about["kind"] == "text/html"}
    tables = {path.stem for path in (finished.folder / "results/tables").glob("*.csv")}
    assert pages == {f"results/report/{name}.html" for name in tables} | {"results/report/provenance/manifest.html"}
    assert all(len(re.sub("<[^>]*>", "", about["caption"]).strip()) > 40 for about in found.values())
    assert {about["category"] for about in found.values()} == {
        "0. Key numbers", "1. The study", "2. The model", "3. Forecasts", "4. Tables", "5. Provenance",
    }  # fmt: skip


@pytest.mark.parametrize("category", ["1. The study", "2. The model", "3. Forecasts"])
def test_every_figure_is_drawn_when_it_is_clicked(page, category):
    """The browser has decoded the picture and gives it room."""
    expected = sum(about["category"] == category for about in listed(page).values())
    sources = set()
    for shown in open_every(page, category):
        picture = shown.wait_for_selector("div.p-3 > img")  # the other picture is Snakemake's logo
        shown.wait_for_function("image => image.complete && image.naturalWidth > 300", arg=picture)
        sources.add(picture.get_attribute("src"))
    assert len(sources) == expected


@pytest.mark.parametrize("category", ["0. Key numbers", "4. Tables", "5. Provenance"])
def test_every_table_is_shown_when_it_is_clicked(page, category):
    """Each in a frame with its rows."""
    expected = sum(about["category"] == category for about in listed(page).values())
    opened = 0
    for shown in open_every(page, category):
        frame = shown.wait_for_selector("iframe").content_frame()
        frame.wait_for_selector("tbody tr")
        opened += 1
    assert opened == expected > 0


def test_key_numbers_on_the_page_are_those_of_the_table(page, finished):
    """One row for each, in order."""
    with (finished.folder / "results/tables/key_numbers.csv").open(encoding="utf-8") as handle:
        expected = [row["key"] for row in csv.DictReader(handle)]
    for shown in open_every(page, "0. Key numbers"):
        frame = shown.wait_for_selector("iframe").content_frame()
        frame.wait_for_selector("tbody tr")
        assert [cell.inner_text() for cell in frame.query_selector_all("tbody td:first-child")] == expected


def test_timings_are_drawn(page):
    """The page of statistics draws a chart of every rule's time."""
    page.goto(page.url.split("#")[0])
    page.click("text=Statistics")
    page.wait_for_selector("#runtimes canvas, #runtimes svg")


def test_nothing_is_fetched_from_outside_and_nothing_fails(page):
    """After all the clicks above: no address but the file and what it holds itself, no error."""
    assert page.asked
    assert [address[:60] for address in page.asked if not address.startswith(("file:", "data:", "blob:"))] == []
    assert page.complaints == []
