# What the report shows: captions, categories and labels of figures and tables.

from string import Template

import yaml

from sedfiber.study.published_comparison import COMPARED

# The errors of each recipe's models.
ERRORS_TABLES = {
    "rollout": "results/tables/forecast_errors.csv",
    "source": "results/tables/forecast_errors_source_recipe.csv",
}


def listed_figures():
    """The entries of report/figures.yaml, with defaults, and with the study's values in place of their $names."""
    shown = NODES[FORECAST_MODEL]
    text = (BASE / "workflow/report/figures.yaml").read_text(encoding="utf-8")
    filled = Template(text).substitute(
        B=STUDY.shown_fall[0],
        angle_index=STUDY.shown_fall[1],
        forecast_model=FORECAST_MODEL,
        latent_dim=shown["latent_dim"],
        errors_table=ERRORS_TABLES[shown["recipe"]],
    )
    listed = yaml.safe_load(filled).items()
    return {name: {"module": name, "file": name, "options": {}} | about for name, about in listed}


FIGURES = listed_figures()
KEY_NUMBERS = "0. Key numbers"
TABLES_CATEGORY = "4. Tables"
PROVENANCE = "5. Provenance"

TABLES = yaml.safe_load((BASE / "workflow/report/tables.yaml").read_text(encoding="utf-8"))
PUBLISHED_TABLES = list(dict.fromkeys(one.table for one in COMPARED))


def drawn(about):
    """The two files of a figure, the SVG with caption, category and labels for the report."""
    shown = report(
        f"results/figures/{about['file']}.svg",
        caption="../report/caption.rst",
        category=about["category"],
        labels={"figure": figure_label(about)},
    )
    return {"svg": shown, "png": f"results/figures/{about['file']}.png"}


def caption_of(about):
    """For caption.rst. Snakemake compares no value that it makes from outputs: a reworded caption redraws nothing."""
    return lambda wildcards, output: about["caption"]


def figures_of(part):
    """The files of all figures that belong to a target rule."""
    files = [about["file"] for about in FIGURES.values() if about["part"] == part]
    return expand("results/figures/{file}.{kind}", file=files, kind=["svg", "png"])


def figure_label(about):
    """One label, since the report makes a switch of a second one; a figure space puts 7 before 10."""
    kind, _, number = about.get("number", "More").partition(" ")
    padded = number.rjust(2, "\u2007") if kind == "Figure" else number
    return f"{kind} {padded}".strip() + f": {about['shows']}"


def shown_in(wildcards):
    """Where the report lists a table."""
    return KEY_NUMBERS if wildcards.table == "key_numbers" else TABLES_CATEGORY


def forecasts_of(split):
    """A test set as the model forecasts it that the figures show."""
    return f"results/forecasts/{FORECAST_MODEL}/{split}.parquet"


def page_parts():
    """Template, style and scripts of the explorer."""
    folder = BASE / "workflow/sedfiber/figures/explorer"
    return [
        here(path) for path in sorted(folder.iterdir()) if path.suffix in (".html", ".css", ".js")
    ]
