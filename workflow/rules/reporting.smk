# What the report shows: captions, categories and labels of figures and tables.

import yaml

from sedfiber.study.published_comparison import COMPARED

FIGURES = yaml.safe_load((BASE / "workflow/report/figures.yaml").read_text(encoding="utf-8"))
# The figures that `all` makes; the others belong to target rules of their own.
STUDY_FIGURES = [name for name, about in FIGURES.items() if about["category"][0] in "123"]
KEY_NUMBERS = "0. Key numbers"
TABLES_CATEGORY = "4. Tables"
PROVENANCE = "5. Provenance"

# The tables that `all` makes.
STUDY_TABLES = [
    "key_numbers",
    "trajectories",
    "audit",
    "regimes",
    "reconstruction",
    "forecast_errors",
    "forecast_errors_source_recipe",
    "forecast_errors_lookup",
    "ensemble_errors",
    "baselines",
    "lags",
    "timings",
]
PUBLISHED_TABLES = list(dict.fromkeys(one.table for one in COMPARED))


def drawn(figure):
    """The two files of a figure, the SVG with caption, category and labels for the report."""
    about = FIGURES[figure]
    shown = report(
        f"results/figures/{figure}.svg",
        caption=f"../report/{figure}.rst",
        category=about["category"],
        labels={"figure": figure_label(about)},
    )
    return {"svg": shown, "png": f"results/figures/{figure}.png"}


def figure_label(about):
    """One label, since the report makes a switch of a second one; a figure space puts 7 before 10."""
    kind, _, number = about.get("number", "More").partition(" ")
    padded = number.rjust(2, "\u2007") if kind == "Figure" else number
    return f"{kind} {padded}".strip() + f": {about['shows']}"


def shown_in(wildcards):
    """Where the report lists a table."""
    return KEY_NUMBERS if wildcards.table == "key_numbers" else TABLES_CATEGORY


def drawn_from(command, *words):
    """The call of a figure's command: ``{name}`` in its words stands for the input of that name."""
    return lambda wildcards, input: " ".join([command, *words]).format(**dict(input.items()))


def forecasts_of(split):
    """A test set as the model forecasts it that the figures show."""
    return f"results/forecasts/{FORECAST_MODEL}/{split}.parquet"


# What the figures of single forecasts read: true falls, the model's forecasts, and its errors.
ERRORS_TABLE = {
    "rollout": "results/tables/forecast_errors.csv",
    "source": "results/tables/forecast_errors_source_recipe.csv",
}[NODES[FORECAST_MODEL]["recipe"]]
PAIRED = [
    "--truth {truth} --forecasts {forecasts} --errors {table}",
    f"--latent-dim {NODES[FORECAST_MODEL]['latent_dim']}",
]


def page_parts():
    """Template, style and scripts of the explorer."""
    folder = BASE / "workflow/sedfiber/figures/explorer"
    return [
        here(path) for path in sorted(folder.iterdir()) if path.suffix in (".html", ".css", ".js")
    ]
