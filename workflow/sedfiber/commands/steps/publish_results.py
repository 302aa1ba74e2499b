"""``sedfiber publish_results``: copy tables, figures and manifest of a full run to where the repository shows them."""

from pathlib import Path

from sedfiber.study.published import publish


def run(
    *,
    results: Path = Path("results"),
    output: Path = Path("results/published"),
    repository: Path = Path(),  # the checkout that ran
) -> None:
    """Copy the results and print how much, or fail where they are not those of this code."""
    files = publish(results, output, repository)
    size = sum(file.stat().st_size for file in files)
    print(f"published {len(files)} files, {size / 1e6:.1f} MB, in {output}; commit them")
