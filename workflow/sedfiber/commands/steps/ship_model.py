"""``sedfiber ship_model``: copy the forecast model of a full run into the package."""

from pathlib import Path

from sedfiber.reduced.model_folder import SHIPPED
from sedfiber.study.shipping import ship


def run(
    *,
    results: Path = Path("results"),
    output: Path = SHIPPED,
    repository: Path = Path(),  # the checkout that ran
) -> None:
    """Copy the model and print its largest errors, or fail where it is not of this code."""
    sets = ship(results, output, repository)["error"]["sets"]
    worst = ", ".join(f"{of_set['E_worst']:.2g} on set {name}" for name, of_set in sets.items())
    print(f"shipped a model whose largest E is {worst}, in {output}; commit it")
