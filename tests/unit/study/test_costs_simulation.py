"""What accuracy costs: the tables count, compare and list what they promise.  Nothing here depends on seconds."""

import json

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import RK45

from sedfiber import Scene, simulate
from sedfiber.commands.cli import main
from sedfiber.core.errors import NumericalError
from sedfiber.study.angles import angle_of
from sedfiber.study.costs import discretisation, integrators
from sedfiber.study.costs.discretisation import GROWTH_COLUMNS, cost_growth, curve_distance, measure_discretisation
from sedfiber.study.costs.fall_problem import FallProblem, OutOfTime
from sedfiber.study.costs.integrators import measure_integrators
from sedfiber.study.costs.methods import METHODS, by_solve_ivp
from sedfiber.study.costs.power_law import fit_power_law
from sedfiber.study.costs.timing import FEW
from sedfiber.study.costs.trajectories import measure_trajectories

SECONDS = ["seconds_least", "seconds_median", "seconds_spread", "repeats"]
COUNTS = ["steps", "rhs", "jacobians", "factorisations"]
ENDS = ["machine", "rhs_unit_s"]
LADDER = (1e-3, 1e-5, 1e-7)
FEW_BEADS, SOFT, ANGLE = 7, 300.0, 5  # a fall that takes a few milliseconds


@pytest.fixture(scope="module")
def compared():
    """All methods over the fall of seven beads."""
    return pd.DataFrame(measure_integrators(SOFT, ANGLE, LADDER, n_beads=FEW_BEADS))


@pytest.fixture(scope="module")
def discretised():
    """Few beads, in all mobilities."""
    return measure_discretisation((5, 9, 11, 15))


def one(table, method, jacobian, tolerance):
    """The one row of a method."""
    rows = table[(table.method == method) & (table.jacobian == jacobian) & np.isclose(table.tolerance, tolerance)]
    assert len(rows) == 1
    return rows.iloc[0]


def short_fall(n_beads=FEW_BEADS, samples=21):
    """The first ten a/U_s of the same fall."""
    return FallProblem(Scene(SOFT, angle_of(ANGLE), n_beads), samples)


# integrators


def test_integrators_table_has_its_columns(compared):
    """In their order, a row for every method and rung of its ladder, all of which ran."""
    facts = ["B", "angle_index", "theta0", "method", "jacobian", "tolerance", "error"]
    ends = ["fraction_of_fall", "seconds_whole_fall", "status", "reference_agreement", *ENDS]
    assert list(compared) == [*facts, *SECONDS, *COUNTS, "rhs_units", *ends]
    assert len(compared) == sum(len(method.ladder(list(LADDER))) for method in METHODS)
    assert (compared.status == "ok").all() and (compared.repeats >= FEW).all()
    assert (compared.fraction_of_fall == 1.0).all()
    assert (compared.reference_agreement < 1e-9).all()


def test_integrators_count_what_they_do(compared):
    """Steps cost right-hand sides; a Jacobian by differences costs one for each coordinate."""
    assert (compared.steps > 0).all() and (compared.rhs >= compared.steps).all()
    for method in ("LSODA", "LSODA (solve_ivp)", "BDF", "Radau"):
        analytic, differences = (one(compared, method, jacobian, 1e-3) for jacobian in ("analytic", "differences"))
        assert 0 < analytic.jacobians <= analytic.factorisations
        assert differences.rhs > analytic.rhs + FEW_BEADS * differences.jacobians
    explicit = compared[compared.jacobian == "none"]
    assert (explicit[["jacobians", "factorisations"]] == 0).all(axis=None)


@pytest.mark.parametrize("method", ["LSODA", "BDF", "Radau"])
def test_error_falls_with_the_tolerance(compared, method):
    """In proportion or a little slower, and no method is far above its tolerance."""
    rows = compared[(compared.method == method) & (compared.jacobian == "analytic")]
    slope = np.polyfit(np.log(rows.tolerance), np.log(rows.error), 1)[0]
    assert 0.6 < slope < 1.4
    assert (rows.error < 10 * rows.tolerance).all()


def test_what_takes_too_long_is_a_row():
    """With a limit of no time every method stops, and its tighter tolerances are not tried; the source has a part."""
    table = pd.DataFrame(measure_integrators(SOFT, ANGLE, LADDER, limit=1e-9, source_limit=0.01, n_beads=FEW_BEADS))
    ours = table[table.method != "source"]
    loosest = ours.groupby(["method", "jacobian"]).head(1)
    assert loosest.status.str.contains("takes longer than 1e-09 s").all() and (loosest.seconds_least > 0).all()
    others = ours.drop(loosest.index)
    assert len(others) and others.status.str.contains("not tried: takes too long already at 1e-03").all()
    assert ours.error.isna().all() and ours.rhs.isna().all()
    source = table[table.method == "source"].iloc[0]
    assert source.status == "ok" and 0.0 < source.fraction_of_fall < 1.0 and source.error < 1e-5
    assert_allclose(source.seconds_whole_fall, source.seconds_least / source.fraction_of_fall)


@pytest.mark.parametrize(
    "outcome, status",
    [(NumericalError("LSODA: stuck"), "LSODA: stuck"), (ValueError("infs or NaNs"), "infs or NaNs"), (None, "success")],
)
def test_what_fails_is_a_row_with_its_reason(monkeypatch, outcome, status):
    """A method that raises, SciPy's errors among them, or that reports success and is 1 L off."""
    method = METHODS[0]

    def integrate(fall, tolerance, seconds):
        if outcome is not None:
            raise outcome
        run = method.integrate(fall, tolerance, seconds)
        return type(run)(run.positions + fall.scene.length, run.counters)

    broken = type(method)("broken", "analytic", integrate)
    monkeypatch.setattr(integrators, "METHODS", (broken,))
    rows = measure_integrators(SOFT, ANGLE, (1e-3, 1e-5), n_beads=FEW_BEADS)
    assert len(rows) == 2 and all(status in row["status"] for row in rows)
    assert all(row["seconds_least"] > 0 for row in rows)


def test_a_run_out_of_time_says_how_far_it_came():
    """Integrators look at the clock after each sample, SciPy's solvers before each step."""
    fall = short_fall()
    with pytest.raises(OutOfTime) as stopped:
        METHODS[0].integrate(fall, 1e-6, 0.0)
    assert 0.0 <= stopped.value.t < fall.times[-1]
    with pytest.raises(OutOfTime):
        by_solve_ivp(RK45, "none", fall, 1e-6, 0.0)


# trajectories


def test_trajectories_table():
    """A row for each run and tolerance; the tighter one is the nearer and takes more."""
    rows = measure_trajectories([(SOFT, 2), (100.0, ANGLE)], (1e-4, 1e-7), FEW_BEADS)
    table = pd.DataFrame(rows)
    facts = ["B", "angle_index", "theta0", "settling_time", "samples", "tolerance", "error"]
    assert list(table) == [*facts, *SECONDS, *COUNTS, "rhs_units", "simulate_seconds", *ENDS]
    assert table[["B", "angle_index"]].drop_duplicates().values.tolist() == [[SOFT, 2], [100.0, ANGLE]]
    loose, tight = table[table.tolerance == 1e-4], table[table.tolerance == 1e-7]
    assert (tight.error.values < loose.error.values).all() and (tight.steps.values > loose.steps.values).all()
    assert (table.error < 10 * table.tolerance).all() and (table.repeats >= FEW).all()
    run = simulate(Scene(SOFT, angle_of(2), FEW_BEADS))
    assert table.settling_time[0] == run.settling_time and table.samples[0] == len(run.t)


# discretisation


def test_discretisation_table(discretised):
    """Shapes come nearer to the finest; free draining falls straight; what is refused says why."""
    table = pd.DataFrame(discretised).set_index(["hydrodynamics", "n_beads"])
    ours = table.loc["RPY"].loc[[9, 11, 15]]
    assert (ours.status == "ok").all() and (np.diff(ours.shape_from_finest_L) < 0).all()
    assert ours.shape_from_finest_L[15] < 1e-15 and (ours.shape_from_RPY_L < 1e-15).all()
    assert (np.diff(ours.speed) > 0).all() and (ours[["rhs_s", "jacobian_s", "lu_s"]] > 0).all(axis=None)
    run = simulate(Scene(1000.0, angle_of(12), 11))
    assert_allclose(ours.speed[11], np.linalg.norm(run.centre[-1] - run.centre[-2]) / 0.5, rtol=1e-2)
    assert (table.loc["RPY-overlap"].shape_from_RPY_L.dropna() < 1e-4).all()
    free = table.loc["none"].loc[[9, 11, 15]]
    assert_allclose(free.speed, 1.0, rtol=1e-9)
    assert free.settling_time.isna().all() and (free.shape_from_finest_L < 1e-9).all()
    assert (free.t_end == ours.t_end).all() and (free.shape_from_RPY_L > 0.1).all()
    assert "does not settle" in table.status["none", 5] and "B=1000" in table.status["RPY", 5]
    assert table.loc["Oseen"].status.str.contains("positive definite").any()


def test_curve_distance_is_zero_on_one_curve_and_the_offset_elsewhere():
    """Beads of two chains on one arc lie on it to the spline's error; a shift shows in full."""

    def arc(n):
        s = (np.arange(n) - n // 2) / n
        return np.column_stack([np.sin(s), 1.0 - np.cos(s), 0.0 * s])

    assert curve_distance(arc(11), arc(101)) < 1e-8
    assert_allclose(curve_distance(arc(11) + np.array([0.0, 0.0, 0.3]), arc(101)), 0.3, rtol=1e-9)


def test_a_power_law_is_recovered():
    """Exactly where there is no scatter; within its standard error, of the right size, where there is."""
    beads = np.array([61, 91, 121, 201, 301])
    exact = fit_power_law(beads, 3e-9 * beads**2.5)
    assert_allclose((exact.exponent, exact.prefactor), (2.5, 3e-9))
    assert exact.standard_error < 1e-9
    rng = np.random.default_rng(0)
    fits = [fit_power_law(beads, 3e-9 * beads**2.5 * np.exp(0.1 * rng.normal(size=5))) for _ in range(400)]
    scatter = np.std([fit.exponent for fit in fits])
    assert_allclose(np.sqrt(np.mean([fit.standard_error**2 for fit in fits])), scatter, rtol=0.15)


def test_growth_of_cost(discretised):
    """Every cost of every mobility that ran; none where there are fewer than three N."""
    grown = pd.DataFrame(cost_growth(discretised, start=9))
    assert list(grown) == GROWTH_COLUMNS
    assert set(grown.hydrodynamics) >= {"RPY", "RPY-overlap", "none"}
    assert grown[grown.hydrodynamics == "RPY"].quantity.tolist() == list(discretisation._QUANTITIES)
    assert (grown.N_from == 9).all() and (grown.N_to == 15).all()
    assert cost_growth(discretised, start=13) == []


# commands


def sedfiber(command, settings, *words):
    """Exit status of the step."""
    return main([command, "--settings", json.dumps(settings), *map(str, words)])


def test_commands_write_their_tables(tmp_path, monkeypatch, capsys):
    """Counts as whole numbers, also beside rows without any."""
    monkeypatch.setattr(integrators, "METHODS", METHODS[:1])
    paths = [tmp_path / f"{name}.csv" for name in "abcd"]
    fall = {"B": SOFT, "angle_index": ANGLE, "n_beads": FEW_BEADS, "tolerances": [1e-3, 1e-5]}
    assert sedfiber("measure_integrators", fall, "-o", paths[0]) == 0
    splits = [{"B": [300, 100], "angle_index": [2]}, {"B": [200], "angle_index": [3, 5]}]
    falls = {"splits": splits, "n_beads": 7, "tolerances": [1e-4]}
    assert sedfiber("measure_trajectories", falls, "-o", paths[1]) == 0
    assert sedfiber("measure_discretisation", {"n_beads": [5, 9]}, "-o", paths[2], "--growth", paths[3]) == 0
    tables = [pd.read_csv(path) for path in paths]
    assert [len(table) for table in tables] == [2, 4, 8, 0]
    assert tables[1][["B", "angle_index"]].values.tolist() == [[300, 2], [100, 2], [200, 3], [200, 5]]
    steps = pd.read_csv(paths[2], dtype=str).steps
    assert all(value.isdigit() for value in steps.dropna()) and steps.isna().any()


@pytest.mark.parametrize(
    "command, settings, words, named",
    [
        ("measure_integrators", {"B": 0, "angle_index": 3}, [], "B"),
        ("measure_integrators", {"angle_index": 3}, [], "B"),
        ("measure_integrators", {"B": 100, "angle_index": 99}, [], "angle_index"),
        ("measure_integrators", {"B": 100, "angle_index": 3, "tolerances": [2]}, [], "tolerances"),
        ("measure_integrators", {"B": 100, "angle_index": 3, "limit": "nan"}, [], "limit"),
        ("measure_integrators", {"B": 100, "angle_index": 3, "limits": 1}, [], "settings"),
        ("measure_trajectories", {"splits": [{"B": [100]}]}, [], "angle_index"),
        ("measure_trajectories", {"splits": [], "tolerances": [1e-11]}, [], "tolerances"),
        ("measure_discretisation", {"n_beads": [4]}, ["--growth", "growth.csv"], "n_beads"),
        ("measure_discretisation", {}, ["--growth", "missing/growth.csv"], "output"),
        ("measure_discretisation", {}, ["--growth", "out.csv"], "growth"),
        ("measure_discretisation", [], ["--growth", "growth.csv"], "settings"),
    ],
)
def test_commands_refuse_in_one_line(tmp_path, monkeypatch, capsys, command, settings, words, named):
    """Before any work is done, naming the key."""
    monkeypatch.chdir(tmp_path)
    assert sedfiber(command, settings, *words, "-o", "out.csv") == 1
    said = capsys.readouterr().err
    assert said.startswith(f"sedfiber {command}: {named}: ") and said.count("\n") == 1
    assert not list(tmp_path.iterdir())
