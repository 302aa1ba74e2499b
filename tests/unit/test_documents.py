"""What the documents say of figures agrees with what the workflow makes and what is published."""

import hashlib
import json
import math
import re
from pathlib import Path

import pandas as pd
import pytest
import yaml

REPOSITORY = Path(__file__).parents[2]
FIGURES = yaml.safe_load((REPOSITORY / "workflow/report/figures.yaml").read_text(encoding="utf-8"))
DOCUMENTS = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("*.md"))]


def test_every_figure_has_a_caption():
    """Some words at least."""
    for name, about in FIGURES.items():
        assert len(about["caption"]) > 70, name


def test_a_reader_finds_each_figure_of_the_paper_by_its_number():
    """One table of docs/figures.md has Figure 1 to 10 and Table 1, each with its file and its rule."""
    text = (REPOSITORY / "docs/figures.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ((?:Figure|Table) \d+) \| \[.*?\]\((.*?)\) \| `[a-z]+_(\w+)` \|", text, re.MULTILINE)
    wanted = {about["number"]: name for name, about in FIGURES.items() if "number" in about}
    assert {number: rule for number, _, rule in rows} == wanted
    assert set(wanted) == {f"Figure {n}" for n in range(1, 11)} | {"Table 1"}
    assert all(path.endswith(f"/{rule}.svg") for _, path, rule in rows)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_every_file_that_a_document_shows_or_links_is_there(document):
    """Pictures are published ones, so that whoever browses the repository sees them."""
    links = re.findall(r"\]\(([^)#]+)\)|<img[^>]* src=\"([^\"]+)\"", document.read_text(encoding="utf-8"))
    for target in (link or picture for link, picture in links):
        assert (document.parent / target).exists(), target
        if target.endswith((".svg", ".png", ".webp")):
            assert "results/published/" in target


ROOMS = ["core", "physics", "scene", "simulation", "reduced", "study", "figures", "commands"]
PACKAGE_PATH = re.compile(rf"`(?:workflow/sedfiber/)?((?:{'|'.join(ROOMS)})/[\w/]*(?:\.\w+)?)`")
TO_BE_WRITTEN = {"physics/trap.py"}  # by a reader of the page on own effects


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_every_package_file_that_a_document_names_is_there(document):
    """A module that moves takes its name on the pages along."""
    named = set(PACKAGE_PATH.findall(document.read_text(encoding="utf-8"))) - TO_BE_WRITTEN
    assert sorted(name for name in named if not (REPOSITORY / "workflow/sedfiber" / name).exists()) == []


@pytest.mark.parametrize("page", ["README.md", "docs/architecture.md"])
def test_rooms_are_listed_in_import_order(page):
    """One row a folder of the package."""
    text = (REPOSITORY / page).read_text(encoding="utf-8")
    assert re.findall(r"^\| `(\w+)/` \|", text, re.MULTILINE) == ROOMS


PUBLISHED = REPOSITORY / "results/published"
README, RESULTS = ((REPOSITORY / name).read_text(encoding="utf-8") for name in ("README.md", "docs/results.md"))
# rows of the README's table, in order
README_KEYS = [
    *("simulation_error", "reconstruction_A", "reconstruction_B"),
    *("ensemble_decoder_d4_A", "ensemble_decoder_d4_B", "worst_decoder_d4_B"),
]
# rows of the table of docs/results.md, in order: key numbers of set A and set B
RESULTS_KEYS = [
    "reconstruction",
    "reconstruction_pod",
    *(f"ensemble_{name}" for name in ("decoder_d4", "decoder_d3", "decoder_d2", "source_d4", "lookup")),
    *(f"worst_{name}" for name in ("decoder_d4", "decoder_d3", "decoder_d2", "source_d4", "lookup")),
]
MEASURED = re.compile(r"\b\d\.\de-\d\b")


def published(table: str) -> pd.DataFrame:
    return pd.read_csv(PUBLISHED / f"tables/{table}.csv")


def key_numbers() -> pd.DataFrame:
    return published("key_numbers").set_index("key")


def shown(number: float, digits: int = 1) -> str:
    """A number as the pages write it, with nothing where there is none."""
    return "" if pd.isna(number) else f"{number:.{digits}e}".replace("e-0", "e-")


def cells(text: str, width: int) -> list[list[str]]:
    """The rows with a measured number of a page's tables of that many columns."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"]
    return [row for row in rows if len(row) == width and any(map(MEASURED.fullmatch, row))]


def test_the_readme_is_short_and_starts_with_commands():
    """At most 150 lines and 1,300 words, a shell command by line 25 and Python by line 60."""
    lines = README.splitlines()
    assert len(lines) <= 150 and len(README.split()) <= 1300
    assert lines.index("```sh") + 2 <= 25 and lines.index("```python") + 2 <= 60
    assert all(words in README for words in ("make reproduce", "make test", "snakemake -j2"))


def test_the_readme_shows_published_numbers():
    """Six rows of the paper, this run and the target; below them the model's range."""
    numbers = key_numbers().loc[README_KEYS]
    expected = [[row.source, shown(row.this_run), shown(row.bar, 0)] for row in numbers.itertuples()]
    assert [row[1:] for row in cells(README, 4)] == expected
    assert f"of its forecasts is {shown(numbers['this_run']['ensemble_decoder_d4_B'])}" in README
    card = json.loads((REPOSITORY / "workflow/sedfiber/reduced/shipped/card.json").read_text(encoding="utf-8"))
    known = card["range"]
    angle = round(known["theta0_max"] * 48 / math.pi)
    text = f"knows {known['n_beads']} beads, ℬ from {known['B_min']:g} to {known['B_max']:g} and |θ₀| up to {angle}π/48"
    assert text in README


def test_the_page_of_results_shows_published_numbers():
    """The key table to the two digits that it shows, and the targets of sets A and B beside it."""
    numbers = key_numbers()
    expected = [
        [shown(numbers["this_run"][f"{key}_{test_set}"]) for test_set in "AB"]
        + [shown(numbers["bar"][f"{key}_{test_set}"], 0) for test_set in "AB"]
        for key in RESULTS_KEYS
    ]
    assert [row[1:] for row in cells(RESULTS, 5)] == expected
    assert numbers["this_run"]["falls"] == numbers["this_run"]["falls_onto_U"] == 227
    ours = numbers.drop([key for key in numbers.index if key.endswith(("d2_A", "d2_B", "d3_A", "d3_B"))])
    assert set(ours["met"].dropna()) == {"yes"}, "at four latent dimensions every target is met"


def test_the_page_of_results_states_what_the_published_tables_say():
    """Regimes, the third dimension, the worst angles and the median errors; the README's threshold is this one's."""
    regimes = published("regimes").query("split == 'train' and angle_index == 12").groupby("regime")["B"]
    (rotation,), bends, snaking = regimes.get_group("rotation")[-1:], regimes.get_group("bending"), "snaking"
    text = f"rotates up to ℬ = {rotation:g}, bends at {' and '.join(f'{B:g}' for B in bends)}, and snakes from"
    assert f"{text} {regimes.get_group(snaking).min():g} on" in RESULTS
    matters = published("audit").query("matters")
    assert set(matters["effect"]) == {"third dimension"}
    listed = "{:g}, {:g} and {:g}".format(*sorted(set(matters["B"])))
    assert f"In {len(matters)} of the 227 runs, all at ℬ = {listed}" in RESULTS
    threshold = re.search(r"The U is stable up to ℬ = ([\d.]+)\.", RESULTS)[1]
    assert f"Above ℬ ≈ {float(threshold):.0f} " in README


def test_the_page_of_results_compares_with_lookup_as_published():
    """Median E on set A without and with a model, and the angles of the worst forecasts."""
    ours = published("forecast_errors").query("latent_dim == 4 and test_set == 'A'")
    lookup = published("forecast_errors_lookup").query("test_set == 'A'")["E_max"].median()
    assert f"median E on set A is {shown(lookup, 0)}, ours {shown(ours['E_max'].median(), 0)}" in RESULTS
    worst = ours.loc[ours.groupby("B")["E_max"].idxmax(), "angle_index"]
    assert (worst == 21).sum() == 5 and worst.iloc[-1] == 1
    assert "k = 21 at five of the seven trained ℬ, k = 1 at the highest" in RESULTS


def test_no_measured_number_stands_on_two_pages_by_hand():
    """Those of the published key numbers may, for the tests above check them."""
    pages = [set(MEASURED.findall(page.read_text(encoding="utf-8"))) for page in DOCUMENTS]
    twice = {number for page in pages for number in page if sum(number in other for other in pages) > 1}
    assert twice <= {shown(number) for number in key_numbers()["this_run"]}


def test_published_files_are_those_of_their_manifest():
    """One run's tables and figures, unchanged since, from committed code."""
    manifest = json.loads((PUBLISHED / "manifest.json").read_text(encoding="utf-8"))
    assert re.fullmatch("[0-9a-f]{40}", manifest["commit"])
    files = [path for path in PUBLISHED.rglob("*") if path.is_file() and path.name != "manifest.json"]
    assert {path.stem for path in files if path.suffix == ".svg"} == {
        name for name, about in FIGURES.items() if about["part"] == "study"
    }
    for path in files:
        name = f"results/{path.relative_to(PUBLISHED)}"
        assert manifest["sha256"][name] == hashlib.sha256(path.read_bytes()).hexdigest(), name
