"""What accuracy costs: every way to a trajectory asked on a few falls, and the tables and the advice made of it.

Nothing here depends on how long anything takes.
"""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from problems import taylor_slope
from sedfiber import InputError, Scene
from sedfiber.commands.cli import main
from sedfiber.reduced.pod import pod_basis
from sedfiber.reduced.scaling import Scales, residual_history
from sedfiber.scene.assembly import assemble
from sedfiber.simulation.equilibria.terminal_curve import FILE, read_terminal_curve
from sedfiber.study.costs.advice import Question, advice
from sedfiber.study.costs.choice import FORECAST, GALERKIN, LOOKUP, SIMULATION, Choice, Outcomes
from sedfiber.study.costs.choice_tables import choices_at_each_B, choices_overall, fastest_simulation
from sedfiber.study.costs.choices import measure_single, measure_sweeps
from sedfiber.study.costs.contestants import (
    compiled_forecasts,
    forecasters,
    galerkins,
    lookups,
    simulations,
    torch_forecast,
)
from sedfiber.study.costs.galerkin import PodGalerkin
from sedfiber.study.costs.queries import queries, stored_queries
from sedfiber.study.hard_cases.training_cases import simulated

N_BEADS = 7
SECONDS = {"seconds_least", "seconds_median", "seconds_spread"}


@pytest.fixture(scope="module")
def training():
    """Two ℬ, four angles."""
    return simulated(N_BEADS, (100.0, 400.0), (2, 8, 14, 20))


@pytest.fixture(scope="module")
def asked():
    """A fall at each of two ℬ that the model was not trained on."""
    return queries(simulated(N_BEADS, (150.0, 300.0), (9,)))


@pytest.fixture(scope="module")
def found(trained_model, training, asked):
    """Everything asked once, with the fewest repeats."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sedfiber.study.costs.timing.REPEATS", 2)
        curve, outcomes = read_terminal_curve(trained_model / FILE), Outcomes()
        at = forecasters(trained_model, [1e-3, 1e-7], curve)
        contestants = [*simulations([1e-3, 1e-5, 1e-7], N_BEADS), *galerkins(training, [4, 14]), *lookups(training)]
        contestants += [*compiled_forecasts("small", at), torch_forecast("small", trained_model, at[1e-7])]
        measure_single(asked, contestants, outcomes)
        measure_sweeps(asked, "small", at, [1, 4], outcomes)
    return outcomes


def outcome_of(found, family, **facts):
    """The one outcome of these facts."""
    (one,) = [o for o in found.family(family) if all(getattr(o.choice, key) == value for key, value in facts.items())]
    return one


def test_the_reference_of_a_query_is_another_method(asked):
    """BDF at 1e-9 differs from the stored run by its error, which is small and not zero."""
    for query in asked:
        assert 0.0 < query.error(query.trajectory.positions) < 1e-5
        assert query.error(query.truth) == query.E(query.truth) == 0.0
    assert stored_queries([asked[0].trajectory])[0].error(asked[0].trajectory.positions) == 0.0


def test_errors_of_simulations_follow_the_tolerance(found):
    """Each hundredfold tighter tolerance brings an error at least ten times smaller, and more right-hand sides."""
    errors = [outcome_of(found, SIMULATION, tolerance=t).column("error") for t in (1e-3, 1e-5, 1e-7)]
    counts = [outcome_of(found, SIMULATION, tolerance=t).column("rhs") for t in (1e-3, 1e-5, 1e-7)]
    assert (errors[1] < errors[0] / 10).all() and (errors[2] < errors[1] / 10).all()
    assert (counts[0] < counts[1]).all() and (counts[1] < counts[2]).all()


def test_forecasts_are_the_same_by_every_path(found):
    """Compiled, by torchdiffeq and in a sweep: the model's error hides how it was integrated; float32 nearly."""
    compiled = outcome_of(found, FORECAST, name="small", tolerance=1e-7, batch=1, precision="float64")
    torch = outcome_of(found, FORECAST, name="small (torch)")
    sweep = outcome_of(found, FORECAST, name="small", tolerance=1e-7, batch=4, precision="float64")
    rough = outcome_of(found, FORECAST, name="small", tolerance=1e-7, batch=4, precision="float32")
    np.testing.assert_allclose(compiled.column("error")[:2], torch.column("error"), rtol=1e-2)
    np.testing.assert_allclose(sweep.column("error"), torch.column("error"), rtol=1e-2)
    np.testing.assert_allclose(rough.column("error"), torch.column("error"), rtol=0.1)
    assert (compiled.column("evaluations")[:2] > 20).all()


def test_galerkin_with_all_modes_is_the_simulation(found):
    """Seven beads have fourteen coordinates, two of them the centre's: twelve modes leave nothing out."""
    few, all_of_them = (outcome_of(found, GALERKIN, name=f"{r} modes").column("error") for r in (4, 14))
    assert (all_of_them < 1e-4).all()
    assert (few > 1e2 * all_of_them).all()


def test_galerkin_has_the_jacobian_of_its_rates(training):
    """Taylor test of second order in a random direction."""
    residuals = np.concatenate([residual_history(one, Scales.of(training)) for one in training])
    one = training.trajectories[1]
    projected = PodGalerkin(assemble(Scene(one.B, one.theta0, N_BEADS)), pod_basis(residuals, 6), one.terminal)
    state = projected.to_state(one.positions[3][:, :2])
    assert np.abs(projected.to_positions(state)[3] - one.positions[3][3]).max() < 1e-12
    direction = np.random.default_rng(0).standard_normal(state.size)
    eps = np.array([1e-3, 3e-4, 1e-4])
    slope = taylor_slope(lambda y: projected.rhs(0.0, y), projected.jacobian(0.0, state), state, direction, eps)
    assert slope == pytest.approx(2.0, abs=0.1)


def test_a_choice_that_fails_is_kept(asked):
    """An infinite error and the reason; what follows goes on."""

    outcomes = Outcomes()
    choice = Choice(SIMULATION, "LSODA", 14, 1e-3)
    outcomes.add(choice, {"error": 1e-3, "E": 1e-6, "seconds_least": 2.0})
    outcomes.fail(choice, "it broke")
    (outcome,) = outcomes.all()
    assert list(outcome.column("error")) == [1e-3, np.inf] and outcome.failures == ["it broke"]
    table = choices_overall(outcomes, {}, 0.0)
    assert table["failed"].item() == 1 and table["error_worst"].item() == np.inf


def test_the_fastest_simulation_is_the_one_that_is_right_enough(found):
    """Of the loosest tolerance where much is allowed, of a tighter one where less is, of the best where none is."""
    loose, middle, tight = (outcome_of(found, SIMULATION, tolerance=t) for t in (1e-3, 1e-5, 1e-7))
    fastest = {name: fastest_simulation(found, errors) for name, errors in {
        "anything": np.array([1.0, 1.0]), "like the middle": middle.column("error"), "nothing": np.zeros(2),
    }.items()}  # fmt: skip
    every = np.array([one.column("seconds_least") for one in (loose, middle, tight)])
    np.testing.assert_array_equal(fastest["anything"], every.min(axis=0))
    np.testing.assert_array_equal(fastest["like the middle"], every[1:].min(axis=0))
    np.testing.assert_array_equal(fastest["nothing"], every[2])


def test_tables_have_a_row_for_every_choice(found, asked):
    """Counts and times beside each other; preparation and break-even where something was trained."""
    overall = choices_overall(found, {"small": 100.0}, 10.0)
    assert len(overall) == len(found.all())
    assert {"error_worst", "E_median", "rhs", "evaluations", "decoded", "rhs_units", *SECONDS} <= set(overall)
    trained = overall[overall["name"] == "small"]
    assert (trained["preparation_seconds"] == 100.0).all() and trained["times_faster"].notna().all()
    assert overall[overall["name"] == "small (torch)"]["preparation_seconds"].eq(100.0).all()
    assert overall[overall["family"] == SIMULATION]["preparation_seconds"].eq(0.0).all()
    assert overall[overall["family"] == LOOKUP]["preparation_seconds"].eq(10.0).all()
    at_each = choices_at_each_B(found, asked, {"small": 100.0}, 10.0)
    assert set(at_each["B"]) == {150.0, 300.0} and len(at_each) == 2 * len(overall)
    worst = at_each.groupby(["family", "name", "tolerance", "batch", "precision"], dropna=False)["error_worst"].max()
    assert sorted(worst) == sorted(overall["error_worst"])


CHOICES = pd.DataFrame(
    [
        {"family": family, "name": name, "tolerance": tolerance, "batch": batch, "precision": "float64", "B": B,
         "error_worst": error * (2.0 if B == 1000.0 else 1.0), "seconds_median": seconds, "preparation_seconds": first}
        for B in (100.0, 1000.0)
        for family, name, tolerance, batch, error, seconds, first in (
            (SIMULATION, "LSODA", 1e-3, 1, 1e-3, 0.004, 0.0),
            (SIMULATION, "LSODA", 1e-6, 1, 1e-6, 0.01, 0.0),
            (FORECAST, "d4", 1e-5, 1, 4e-3, 0.0004, 300.0),
            (FORECAST, "d4", 1e-5, 1000, 4e-3, 0.0001, 300.0),
        )
    ]
)  # fmt: skip
BEADS = pd.DataFrame(
    {
        "B": 1000.0,
        "hydrodynamics": "RPY",
        "status": "ok",
        "n_beads": [31, 61, 121],
        "shape_from_finest_L": [4e-2, 5e-3, 0.0],
    }
)


def answer(B, error, queries=1, scale=1.0):
    """The advice as one text."""
    return "\n".join(advice(Question(B, error, queries), CHOICES, BEADS, scale))


def test_advice_takes_the_worse_of_two_neighbours():
    """Between 100 and 1000 an error of 1e-3 and one of 2e-3 count as 2e-3."""
    assert "choose simulation by LSODA at tolerance 1e-06: error up to 2.0e-06 L, 10 ms a trajectory" in answer(
        500, 1e-3
    )
    assert "choose simulation by LSODA at tolerance 0.001: error up to 1.0e-03 L" in answer(100, 1e-3)


def test_advice_weighs_training_against_queries():
    """A model for 1e-2; what training takes, when it is earned back, and what is best without it."""
    words = answer(500, 1e-2, 1000)
    assert "choose forecast by d4 at tolerance 1e-05, 1000 at once in float64" in words
    assert "training it first takes 5 min more, earned back after 7.7e+04 trajectories" in words
    assert "without a trained model: simulation by LSODA at tolerance 0.001" in words
    assert "1000 at once" not in answer(500, 1e-2, 999)
    assert "without a trained model" not in answer(500, 1e-2, 10**6)


def test_advice_says_what_is_out_of_reach_or_was_not_measured():
    """A ℬ outside the tables, an error below all of them, a better one that nothing reaches; more beads."""
    assert "B lies outside what was measured, 100 to 1000" in answer(5000, 1e-2)
    assert "nothing that was measured reaches it; the most accurate: simulation" in answer(500, 1e-9)
    assert "no model is accurate enough; the most accurate: forecast by d4" in answer(500, 1e-3)
    assert "a tenth of the error is beyond what was measured" in answer(500, 1e-6 * 5)
    assert "costs 2.5 times as much: simulation by LSODA at tolerance 1e-06" in answer(100, 1e-3)
    assert "right to 0.01 L from 61 beads on" in answer(500, 1e-2)
    assert "right to 0.001 L not below 121 beads" in answer(500, 1e-3)


def test_advice_is_scaled_to_the_machine():
    """Twice as slow a right-hand side: twice the time."""
    assert "20 ms a trajectory" in answer(500, 1e-3, scale=2.0)
    assert "2.00 times as long as in the tables" in answer(500, 1e-3, scale=2.0)


def test_the_command_advises_from_its_tables(tmp_path, capsys, monkeypatch):
    """From files; without them it says what makes them; nonsense is refused by name."""
    monkeypatch.setattr("sedfiber.commands.advise.calibrated_unit", lambda: 1e-5)
    CHOICES.assign(rhs_unit_s=5e-6).to_csv(tmp_path / "cost_choices.csv")
    assert main(["advise", "--B", "500", "--error", "1e-3", "--tables", str(tmp_path)]) == 1
    assert "cost_discretisation.csv' does not exist; run `snakemake -j1 cost` first" in capsys.readouterr().err
    BEADS.to_csv(tmp_path / "cost_discretisation.csv")
    assert main(["advise", "--B", "500", "--error", "1e-3", "--tables", str(tmp_path)]) == 0
    assert "20 ms a trajectory" in capsys.readouterr().out
    for option, value in (("--B", "-1"), ("--error", "0"), ("--queries", "0.5")):
        given = {"--B": "500", "--error": "1e-3", "--tables": str(tmp_path)} | {option: value}
        assert main(["advise", *(word for pair in given.items() for word in pair)]) == 1
        assert option.removeprefix("--") in capsys.readouterr().err


def test_what_snakemake_measured_is_summed(tmp_path):
    """The column of seconds; a file of something else is refused."""
    from sedfiber.commands.steps._benchmark_files import seconds_of

    for name, seconds in (("one", 1.5), ("two", 2.0)):
        (tmp_path / name).write_text(f"s\th:m:s\n{seconds}\t0:00:01\n")
    assert seconds_of([tmp_path / "one", tmp_path / "two"]) == 3.5
    (tmp_path / "three").write_text("nothing\n")
    with pytest.raises(InputError, match="three' is not a benchmark file"):
        seconds_of([Path(tmp_path / "three")])
