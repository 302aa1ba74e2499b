"""The figures of costs: panels, footer, omissions and infinities; a missing column is a one-line error."""

from collections.abc import Callable
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from matplotlib.style import context

from figure_command import draw_words
from sedfiber.commands.cli import main
from sedfiber.core.errors import InputError
from sedfiber.figures.cost_decision import draw as draw_cost_decision
from sedfiber.figures.cost_integrators import draw as draw_cost_integrators
from sedfiber.figures.cost_models import draw as draw_cost_models
from sedfiber.figures.cost_physics import draw as draw_cost_physics
from sedfiber.figures.style import RC_PARAMS

MACHINE = {"machine": "Some CPU, 1 thread; Python 3.11, NumPy 2", "rhs_unit_s": 5.7e-6}


def table(rows: list[tuple], columns: str) -> pd.DataFrame:
    return pd.DataFrame(rows, columns=columns.split()).assign(**MACHINE)


def integrators() -> pd.DataFrame:
    rows = []
    for B, k in product((100, 1000), (12, 22)):
        rows += [(B, k, "LSODA", "analytic", tol, 10 * tol, 1e-2, 1e-3, 1.0, "ok") for tol in (1e-4, 1e-6)]
        rows += [(B, k, "BDF", "differences", 1e-4, None, 0.2, None, None, "a solver's words (and some more)")]
        rows += [(B, k, "RK45", "none", 1e-2, None, 5.0, None, 0.1, "takes longer than 5 s")]
        rows += [(B, k, "RK45", "none", 1e-6, None, None, None, None, "not tried: takes too long already at 1e-02")]
        rows += [(B, k, "source", "none", 1e-6, 1e-7, 900.0, 0.0, 0.04, "ok")]
    return table(
        rows, "B angle_index method jacobian tolerance error seconds_whole_fall seconds_spread fraction_of_fall status"
    )


def discretisation() -> pd.DataFrame:
    rows = [
        (1000, 12, n, name, "ok", 4 + n / 100, 100.0 + n, n**2 * 1e-5, 1e-6 * n, 1e-6 * n, 1e-6 * n, 1 / n, 1e-6 / n)
        for n, name in product((11, 31, 61), ("RPY", "RPY-overlap"))
    ]
    rows += [(1000, 12, n, "none", "ok", 1.0, None, 1e-3, 1e-6, 1e-6, 1e-6, 1e-16, 0.7) for n in (11, 31, 61)]
    rows += [(1000, 12, 11, "Oseen", "hydrodynamics: not positive definite (by far); give RPY", *8 * [None])]
    return table(
        rows,
        "B angle_index n_beads hydrodynamics status speed settling_time seconds_least rhs_s jacobian_s lu_s"
        " shape_from_finest_L shape_from_RPY_L",
    )


def growth() -> pd.DataFrame:
    return table(
        [("RPY", name, 1.9, 0.1, 1e-8, 11, 61) for name in ("right-hand side", "Jacobian", "LU factorisation")],
        "hydrodynamics quantity exponent standard_error prefactor_s N_from N_to",
    )


def model_growth() -> pd.DataFrame:
    rows = []
    for n in (31, 61):
        rows += [(n, 316.0, "simulation", tol, 1, "float64", tol, 1e-4 * n) for tol in (1e-1, 1e-3)]
        rows += [(n, 316.0, "forecast", 1e-4, 1, "float64", np.inf, None)]
        rows += [(n, 316.0, "forecast", 1e-4, 100, p, 2e-2, 1e-6 * n) for p in ("float64", "float32")]
    return table(rows, "n_beads B family tolerance batch precision error seconds_least")


def models() -> pd.DataFrame:
    rows = [
        (variant, d, seed, recipe, seconds, s, 1e-4 / d, np.inf if d == 1 else 1e-3 / (1 + seed), 1e-5)
        for variant, d, seed, (recipe, seconds), s in product(
            ("none", "decoder"), (1, 2), (0, 1), (("study", 200.0), ("short", 20.0)), "AB"
        )
    ]
    return table(
        rows,
        "variant latent_dim seed recipe training_seconds test_set reconstruction_loss E_worst E_median",
    )


def decision() -> pd.DataFrame:
    rows = [("simulation", "LSODA", 62, tol, 1, "float64", tol, tol / 9, 1e-2, 0.0, None, None) for tol in (1e-2, 1e-4)]
    rows += [("lookup", "splines", 0, None, 1, "float64", 0.3, 1e-2, 1e-4, 14.0, 60.0, 1800.0)]
    rows += [("POD-Galerkin", "8 modes", 8, 1e-5, 1, "float64", 0.1, 1e-2, 9e-3, 14.0, 0.8, np.inf)]
    for (d, worst), tol in product(((2, 0.04), (4, np.inf)), (1e-4, 1e-6)):
        rows += [
            ("forecast", f"model_{d}", d, tol, b, p, worst, 5e-3, 1e-3 / b, 700.0, 9.0 * b, 7e4)
            for b, p in product((1, 1000), ("float64", "float32"))
        ]
    rows += [("forecast", "model_2 (torch)", 2, 1e-9, 1, "float64", 0.04, 5e-3, 0.4, 700.0, None, None)]
    return table(
        rows,
        "family name dimension tolerance batch precision error_worst error_median seconds_least preparation_seconds"
        " times_faster break_even_queries",
    )


def drawn(draw: Callable[[], Figure]) -> Figure:
    with context(["default", RC_PARAMS]):
        figure = draw()
        figure.draw_without_rendering()
    return figure


def words(figure: Figure) -> str:
    """Everything that is written in a figure outside its axes, and in them."""
    inside = [text.get_text() for axes in figure.axes for text in axes.texts]
    return "\n".join([text.get_text() for text in figure.texts] + inside)


FIGURES = {  # how to draw, panels, a column it cannot do without
    "integrators": (lambda t: draw_cost_integrators(t), integrators, 4, "seconds_whole_fall"),
    "physics": (lambda t: draw_cost_physics(t, growth(), model_growth()), discretisation, 4, "lu_s"),
    "models": (lambda t: draw_cost_models(t), models, 4, "training_seconds"),
    "decision": (lambda t: draw_cost_decision(t), decision, 3, "break_even_queries"),
}
each_figure = pytest.mark.parametrize("name", FIGURES)


@each_figure
def test_panels_and_a_footer_that_nothing_lies_on(name):
    draw, make, panels, _ = FIGURES[name]
    figure = drawn(lambda: draw(make()))
    assert len(figure.axes) == panels
    assert MACHINE["machine"] in words(figure) and "takes 5.7 µs here" in words(figure)
    (footer,) = figure.findobj(lambda artist: artist.get_gid() == "footer")
    strip = footer.get_window_extent()
    assert strip.x0 >= 0.0 and strip.x1 <= figure.bbox.width
    assert all(artist.get_tightbbox().y0 >= strip.y1 for artist in (*figure.axes, *figure.legends))
    for axes, legend in product(figure.axes, figure.legends):
        assert axes.get_tightbbox().y0 >= legend.get_tightbbox().y1


@each_figure
@pytest.mark.parametrize("own", [True, False])
def test_a_missing_column_is_named_in_one_line(name, own):
    draw, make, _, column = FIGURES[name]
    missing = column if own else "machine"
    with pytest.raises(InputError) as caught:
        drawn(lambda: draw(make().drop(columns=missing)))
    assert f"no column {missing};" in str(caught.value) and "\n" not in str(caught.value)


@each_figure
def test_a_table_without_rows_is_refused(name):
    draw, make, _, _ = FIGURES[name]
    with pytest.raises(InputError, match="no rows"):
        drawn(lambda: draw(make().head(0)))


def test_omitted_integrators_are_listed_with_their_panels():
    written = words(drawn(lambda: draw_cost_integrators(integrators()))).replace("\n", " ")
    assert "takes longer than 5 s at 1e-2 and tighter: RK45 in a, b, c, d" in written
    assert "a solver's words (and some more) at 1e-4: BDF by differences in a, b, c, d" in written
    assert "not tried" not in written
    assert "timed over 4 %" in written


@pytest.mark.parametrize(
    ("name", "column", "stranger"),
    [
        ("integrators", "method", "Euler"),
        ("integrators", "jacobian", "guessed"),
        ("physics", "hydrodynamics", "full"),
        ("models", "variant", "triple"),
        ("models", "recipe", "guess"),
    ],
)
def test_what_has_no_look_is_refused(name, column, stranger):
    draw, make, _, _ = FIGURES[name]
    with pytest.raises(InputError, match=stranger):
        drawn(lambda: draw(make().assign(**{column: stranger})))


def test_failed_mobilities_are_listed_and_few_beads_need_no_law():
    without = growth().head(0)
    figure = drawn(lambda: draw_cost_physics(discretisation(), without, model_growth()))
    assert "Oseen at N = 11" in words(figure) and "not positive definite" in words(figure)
    assert "Not in (a), as nothing changes" in words(figure)


def test_failed_forecasts_are_above_all_others():
    figure = drawn(lambda: draw_cost_models(models()))
    for axes in figure.axes:
        crosses = [y for line in axes.lines if line.get_marker() == "x" for y in line.get_ydata()]
        others = [y for line in axes.lines if line.get_marker() == "o" for y in line.get_ydata()]
        assert min(crosses) > max(others)


def test_queries_until_it_pays_are_told_even_if_unflattering():
    written = words(drawn(lambda: draw_cost_decision(decision())))
    assert "never (0.8×)" in written and "1 800 (60×)" in written and "1000 at once" in written


@pytest.mark.parametrize("missing", ["simulation", "forecast", "lookup", "POD-Galerkin"])
def test_any_family_may_be_missing(missing):
    rows = decision()
    figure = drawn(lambda: draw_cost_decision(rows[rows["family"] != missing].reset_index(drop=True)))
    assert len(figure.axes) == 3


TABLES = {
    "cost_integrators": {"table": integrators},
    "cost_physics": {"table": discretisation, "growth": growth, "models": model_growth},
    "cost_models": {"table": models},
    "cost_decision": {"table": decision},
}


@pytest.mark.slow
@pytest.mark.parametrize("figure", TABLES)
def test_the_command_writes_both_files(figure, tmp_path):
    svg, png = plotted(figure, TABLES[figure], tmp_path)
    assert svg.startswith(b"<?xml") and png.startswith(b"\x89PNG")


def plotted(figure: str, tables: dict[str, Callable[[], pd.DataFrame]], folder: Path) -> tuple[bytes, bytes]:
    for name, make in tables.items():
        make().to_csv(folder / f"{name}.csv", index=False)
    assert main(draw_words(figure, folder, {name: folder / f"{name}.csv" for name in tables})) == 0
    return (folder / "x.svg").read_bytes(), (folder / "x.png").read_bytes()
