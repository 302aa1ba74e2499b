"""What the documents say of figures agrees with what the workflow makes and what is published."""

import hashlib
import json
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


def test_a_reader_finds_each_figure_of_the_source_by_its_number():
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


PUBLISHED = REPOSITORY / "results/published"
# rows of the README's table, in order: the key numbers of set A and set B
KEY_ROWS = [
    "reconstruction",
    "reconstruction_pod",
    *(f"ensemble_{name}" for name in ("decoder_d4", "decoder_d3", "decoder_d2", "source_d4", "lookup")),
    *(f"worst_{name}" for name in ("decoder_d4", "decoder_d3", "decoder_d2", "source_d4", "lookup")),
]


def test_the_readmes_numbers_are_the_published_ones():
    """The key table to the two digits that it shows, and the numbers in the text below it."""
    published = pd.read_csv(PUBLISHED / "tables/key_numbers.csv").set_index("key")["this_run"]
    text = (REPOSITORY / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| [^|]+ \| (\d\.\de-\d) \| (\d\.\de-\d) \|", text, re.MULTILINE)
    assert len(rows) == len(KEY_ROWS)
    for key, shown in zip(KEY_ROWS, rows, strict=True):
        measured = [f"{published[f'{key}_{test_set}']:.1e}".replace("e-0", "e-") for test_set in "AB"]
        assert list(shown) == measured, key
    assert f"{published['simulation_error']:.1e}".replace("e-0", "e-") in text
    assert published["falls"] == published["falls_onto_U"] == 227


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
