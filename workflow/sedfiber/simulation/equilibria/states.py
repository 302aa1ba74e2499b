"""Stability of the model's own steady states: a row for each state, and the ℬ at which it changes.

A state is stable in the plane when all disturbances within its plane decay, and in volume when
those across it decay too.  Each growth rate is an eigenvalue, and is measured a second time by
integrating the equations of motion from a small disturbance along its mode.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise

from sedfiber.simulation.equilibria.branches import Branch, spectrum_of
from sedfiber.simulation.equilibria.growth import measured_rate
from sedfiber.simulation.equilibria.spectrum import Mode, Spectrum
from sedfiber.simulation.equilibria.steady import SteadyState

NEAR = 1e-3  # of ℬ: how far from a threshold the rates on its two sides are measured
MEANINGFUL = 1e-7  # U_s/a: below this a rate is round-off, and a ratio of two says nothing
_SAME = 1e-6  # of ℬ: thresholds nearer than this are one

THRESHOLD_COLUMNS = ("branch", "threshold", "B", "rate_below", "rate_above", "accuracy")

Pick = Callable[[Spectrum], Mode]


def state_rows(branch: Branch, grid: Iterable[float], B_min: float, B_max: float) -> list[dict]:
    """A row for each state of a branch at the grid's ℬ and at its folds from ``B_min`` to ``B_max``."""
    states = [state for B in grid if (state := branch.state(B)) is not None]
    states += [fold for fold, _ in branch.folds if B_min <= fold.B <= B_max]
    return [_state_row(branch, state) for state in sorted(states, key=lambda state: state.B)]


def threshold_rows(branches: Sequence[Branch], B_min: float, B_max: float) -> list[dict]:
    """A row for each fold, and for each ℬ at which a leading rate changes sign, or the number of unstable modes.

    ``accuracy``, of ℬ, is what two searches from different sides differ by.  ``rate_below`` and
    ``rate_above`` are measured at 0.999 and 1.001 of the threshold; a fold has neither.
    """
    rows: list[dict] = []
    for branch in branches:
        for row in (*_folds(branch), *_rate_changes(branch)):
            if B_min <= row["B"] <= B_max and not any(_same(row, other) for other in rows):
                rows.append(row)
    return rows


def disagreement(rows: Iterable[dict]) -> tuple[float, int, int]:
    """Largest |measured/predicted − 1|, of how many rates, and how many were too near zero to be compared."""
    pairs = [(row[f"{plane}_measured"], row[f"{plane}_rate"]) for row in rows for plane in ("in_plane", "out_of_plane")]
    ratios = [measured / rate for measured, rate in pairs if abs(rate) >= MEANINGFUL]
    return max(abs(ratio - 1.0) for ratio in ratios), len(ratios), len(pairs) - len(ratios)


def _state_row(branch: Branch, state: SteadyState) -> dict:
    """Lengths in a, speeds in U_s, rates in U_s/a.  At a fold one mode is neutral: nothing there is stable."""
    modes = spectrum_of(branch, state)
    firm = not _is_fold(branch, state)
    return {
        "branch": branch.name,
        "B": state.B,
        "speed": state.speed,
        "height": state.height,
        "end_to_end": state.end_to_end,
        "length": branch.scene.length,
        "residual": state.residual,
        "in_plane_rate": modes.in_plane_rate,
        "in_plane_symmetric_rate": None if branch.name == "vertical" else _symmetric(modes).rate.real,
        "in_plane_measured": _measured(branch, state, modes, modes.in_plane[0]),
        "out_of_plane_rate": modes.out_of_plane_rate,
        "out_of_plane_measured": _measured(branch, state, modes, modes.out_of_plane[0]),
        "stable_in_plane": modes.stable_in_plane and firm,
        "stable_in_volume": modes.stable_in_volume and firm,
    }


def _symmetric(modes: Spectrum) -> Mode:
    """The fastest growing of the modes in the plane that keep the mirror symmetry."""
    return next(mode for mode in modes.in_plane if mode.symmetric)


def _measured(branch: Branch, state: SteadyState, modes: Spectrum, mode: Mode) -> float:
    fastest = max(modes.in_plane_rate, modes.out_of_plane_rate)
    return measured_rate(replace(branch.scene, B=state.B), state.positions, mode, fastest)


def _is_fold(branch: Branch, state: SteadyState) -> bool:
    return any(state.B == fold.B for fold, _ in branch.folds)


def _same(one: dict, other: dict) -> bool:
    """Two sections end in one fold; two modes of an oscillating pair change sign together."""
    return one["threshold"] == other["threshold"] and abs(one["B"] / other["B"] - 1.0) < _SAME


def _folds(branch: Branch) -> Iterator[dict]:
    for fold, accuracy in branch.folds:
        yield _threshold_row(branch, "fold", fold, accuracy)


def _rate_changes(branch: Branch) -> Iterator[dict]:
    spectra = [spectrum_of(branch, state) for state in branch.states]
    for words, pick in _watched(branch, spectra):
        rates = [_rate(branch, *pair, pick) for pair in zip(branch.states, spectra, strict=True)]
        for k, (low, high) in enumerate(pairwise(rates)):
            if low * high < 0.0:
                found = branch.root(k, partial(_growth, branch, pick))
                yield _threshold_row(branch, words, *found, pick)


def _watched(branch: Branch, spectra: Sequence[Spectrum]) -> Iterator[tuple[str, Pick]]:
    """The modes whose rates may change sign: the leading ones, of the vertical fiber all that grow somewhere."""
    if branch.name == "vertical":
        growing = max(sum(mode.rate.real > 0.0 for mode in modes.out_of_plane) for modes in spectra)
        for k in range(growing):
            yield "number of unstable modes changes", _out_of_plane(k)
        return
    yield "in-plane rate changes sign", lambda modes: modes.in_plane[0]
    yield "in-plane symmetric rate changes sign", _symmetric
    yield "out-of-plane rate changes sign", _out_of_plane(0)


def _out_of_plane(k: int) -> Pick:
    return lambda modes: modes.out_of_plane[k]


def _growth(branch: Branch, pick: Pick, state: SteadyState) -> float:
    return pick(spectrum_of(branch, state)).rate.real


def _rate(branch: Branch, state: SteadyState, modes: Spectrum, pick: Pick) -> float:
    """Growth rate of the picked mode; zero for the neutral mode of a fold, whose sign is round-off."""
    rate = pick(modes).rate.real
    return 0.0 if _is_fold(branch, state) and abs(rate) < MEANINGFUL else rate


def _threshold_row(branch: Branch, words: str, state: SteadyState, accuracy: float, pick: Pick | None = None) -> dict:
    below, above = (_measured_at(branch, state.B * (1.0 + side * NEAR), pick) for side in (-1.0, 1.0))
    return dict(zip(THRESHOLD_COLUMNS, (branch.name, words, state.B, below, above, accuracy), strict=True))


def _measured_at(branch: Branch, B: float, pick: Pick | None) -> float:
    """Rate of the picked mode by time integration; NaN without a state or a mode to watch."""
    if pick is None or (state := branch.state(B)) is None:
        return float("nan")
    modes = spectrum_of(branch, state)
    return _measured(branch, state, modes, pick(modes))
