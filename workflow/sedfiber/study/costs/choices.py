"""Every way to an answer on every test trajectory: simulations, forecasts, the lookup and POD–Galerkin.

All are timed in one process, trajectory by trajectory, so that a busy machine slows all of them alike.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from itertools import cycle, islice

import numpy as np

from sedfiber.core.errors import NumericalError
from sedfiber.reduced.forecaster import Forecaster
from sedfiber.study.costs.choice import FORECAST, Choice, Outcomes
from sedfiber.study.costs.contestants import Contestant
from sedfiber.study.costs.queries import Query
from sedfiber.study.costs.timing import timed, timed_run

PRECISIONS = {"float64": np.float64, "float32": np.float32}


def measure_single(asked: Sequence[Query], contestants: Sequence[Contestant], found: Outcomes) -> None:
    """Ask every contestant every query; one that fails has an infinite error there."""
    _warm_up(asked[0], contestants)
    for query in asked:
        unit = timed(query.fall.rhs).least
        for contestant in contestants:
            try:
                timing = timed_run(contestant.ask(query))
            except NumericalError as error:
                found.fail(contestant.choice, str(error))
                continue
            positions, counts = timing.returned
            units = {"rhs_units": timing.least / unit}
            found.add(contestant.choice, _errors(query, positions) | timing.columns | units | counts)


def _warm_up(query: Query, contestants: Sequence[Contestant]) -> None:
    """The first call of all compiles what was never compiled, which may take half a minute."""
    for contestant in contestants:
        with suppress(NumericalError):
            contestant.ask(query)()


def measure_sweeps(
    asked: Sequence[Query], name: str, at: Mapping[float, Forecaster], batches: Sequence[int], found: Outcomes
) -> None:
    """So many forecasts at once, of the queries over and over; a row a query, with the mean time of them all.

    The queries are shuffled, so that few of them are as long and as short as all.  A forecast does not
    depend on its companions, so the errors are those of one sweep over all queries.
    """
    shuffled = [asked[i] for i in np.random.default_rng(0).permutation(len(asked))]
    for tolerance, forecaster in at.items():
        for precision in PRECISIONS:
            positions = _answers(asked, forecaster, precision)
            errors = [_errors(query, rows) for query, rows in zip(asked, positions, strict=True)]
            for batch in batches:
                if batch == 1 and precision == "float64":
                    continue  # the single forecast, which is measured by itself
                choice = Choice(FORECAST, name, forecaster.model.latent_dim, tolerance, batch, precision)
                columns = _sweep_time(list(islice(cycle(shuffled), batch)), forecaster, precision)
                for row in errors:
                    found.add(choice, row | columns)


def _answers(asked: Sequence[Query], forecaster: Forecaster, precision: str) -> list[np.ndarray]:
    positions, offsets = _sweep(asked, forecaster, precision)()
    return np.split(positions, offsets[1:-1])


def _sweep_time(many: Sequence[Query], forecaster: Forecaster, precision: str) -> dict:
    room = np.empty((sum(len(one.truth) for one in many), forecaster.model.scales.n_beads, 2), PRECISIONS[precision])
    room.fill(0.0)  # memory is handed out when it is first written to, which takes longer than the forecasts
    timing = timed_run(_sweep(many, forecaster, precision, room), many[0].fall.rhs)
    model, n = forecaster.model, len(many)
    columns = {key: value / n if key.startswith("seconds") else value for key, value in timing.columns.items()}
    counts = {"evaluations": model.evaluations / n, "decoded": model.decoded / n}
    return columns | counts | {"rhs_units": timing.units / n}


def _sweep(
    many: Sequence[Query], forecaster: Forecaster, precision: str, out: np.ndarray | None = None
) -> Callable[[], tuple[np.ndarray, np.ndarray]]:
    B, theta0 = (np.array([getattr(one.trajectory, key) for one in many]) for key in ("B", "theta0"))
    counts, interval = [len(one.truth) for one in many], many[0].fall.interval
    return lambda: forecaster.sweep(B, theta0, interval, counts, out, PRECISIONS[precision])


def _errors(query: Query, positions: np.ndarray) -> dict[str, float]:
    return {"error": query.error(positions), "E": query.E(positions)}
