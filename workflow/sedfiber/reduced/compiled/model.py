"""Forecasts by a trained model in compiled code, without torch: those of `learning.forecast`, sooner.

    h(0) = E(X̌(0); ℬ),   dh/dt = F_h(h; ℬ) − A h,   dc/dt = F_c(h; ℬ)
    X(t) = c(t) + X̄_term(ℬ) + (L/2) D(h(t); ℬ)

The path h(t), c(t) comes from an adaptive Runge–Kutta pair with a continuous extension
(`latent_path`), bead positions are decoded at a few of its points and interpolated between
(`bead_path`). Many starts that each have their own ℬ are advanced together by `sweep` (`batch`).

A model keeps the memory that its kernels write to: threads need a model each.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sedfiber.core.array_types import Array, History, Times
from sedfiber.core.errors import InputError
from sedfiber.reduced.compiled import batch, single
from sedfiber.reduced.compiled.bead_path import scratch
from sedfiber.reduced.compiled.latent_path import DONE, NOT_FINITE
from sedfiber.reduced.compiled.network import cast
from sedfiber.reduced.compiled.tables import Tensors, tables
from sedfiber.reduced.compiled.tolerances import ATOL, RTOL
from sedfiber.reduced.compiled.trained import TrainedModel, ascending, left_the_numbers, load, stuck
from sedfiber.reduced.forecast_start import Start


class CompiledModel(TrainedModel):
    """Encoder, decoder and neural ODE; ``rtol`` and ``atol`` (units of h and of L/2) bound the error of a step.

    ``evaluations`` are those of the rates in the last call, ``decoded`` the shapes decoded.
    """

    def __init__(self, tensors: Tensors, card: dict[str, Any], rtol: float = RTOL, atol: float = ATOL) -> None:
        super().__init__(tensors, card, rtol, atol)
        self.evaluations = self.decoded = 0
        self._tables = {2: tables(tensors, self.scales.half_length, 2), 3: self._volume}
        self._memory = {dim: self._scratch(dim, np.float64) for dim in (2, 3)}
        self._works: dict[Any, tuple[batch.Work, batch.Lanes]] = {}

    def forecast_many(self, starts: Sequence[Start], t: Times) -> Array:
        """Positions (S, T, N, 3) at times ``t`` (T,), ascending from ``t[0]`` ≥ 0, of S starts, one by one.

        Raises InputError for shapes or times that do not fit the model, NumericalError when
        the integration fails.
        """
        out = np.empty((len(starts), len(t), self.scales.n_beads, 3))
        counts = [self._forecast(start, t, 3, rows) for start, rows in zip(starts, out, strict=True)]
        self.evaluations, self.decoded = (sum(column) for column in zip(*counts, strict=True))
        return out

    def forecast(self, start: Start, t: Times, out: Array | None = None) -> History:
        """Positions (T, N, 3) of one start, written into ``out`` where it is given; raises as `forecast_many`."""
        out = np.empty((len(t), self.scales.n_beads, 3)) if out is None else out
        self.evaluations, self.decoded = self._forecast(start, t, 3, out)
        return out

    def forecast_plane(self, start: Start, t: Times, out: Array | None = None) -> Array:
        """Positions in the plane of motion (T, N, 2), written into ``out`` where it is given; raises as above."""
        out = np.empty((len(t), self.scales.n_beads, 2)) if out is None else out
        self.evaluations, self.decoded = self._forecast(start, t, 2, out)
        return out

    def sweep(
        self,
        starts: Sequence[Start],
        interval: float,
        counts: Sequence[int],
        out: Array | None = None,
        dtype: type = np.float64,
    ) -> tuple[Array, Array]:
        """Positions (sum counts, N, 2) in the plane of motion, start after start, and where each begins (S + 1,).

        Start s has ``counts[s]`` samples, at 0, ``interval``, 2 ``interval``, …. In float32 the
        networks and the output have that precision, and a tolerance is at least 10 roundings.
        """
        offsets = np.concatenate([[0], np.cumsum(counts, dtype=np.int64)])
        out = np.empty((offsets[-1], self.scales.n_beads, 2), dtype) if out is None else out
        self._require_memory(out, (offsets[-1], self.scales.n_beads, 2), dtype)
        self._require_counts(starts, interval, counts)
        self.evaluations = self.decoded = 0
        if len(starts) == 0:
            return out, offsets
        columns = self._columns(starts, interval * np.arange(max(counts)), np.asarray(counts, np.int64), offsets)
        rtol, atol = (max(tolerance, 10 * float(np.finfo(dtype).eps)) for tolerance in (self.rtol, self.atol))
        rows = out.reshape(len(out), -1)
        status, which, when, *used = batch.sweep(self._tables[2], *self._work(dtype), columns, rtol, atol, rows)
        _require_done(status, when, starts[which])
        self.evaluations, self.decoded = used
        return out, offsets

    def _forecast(self, start: Start, t: Times, dim: int, out: Array) -> tuple[int, int]:
        """Fill ``out`` (T, N, dim); evaluations and rows decoded."""
        self._require_shapes(start)
        t = ascending(t)
        self._require_memory(out, (len(t), self.scales.n_beads, dim), np.float64)
        origin, rows = self._origin(start), out.reshape(len(t), -1)
        status, when, *used = single.forecast(
            self._tables[dim], origin, t, self.rtol, self.atol, self._memory[dim], rows
        )
        _require_done(status, when, start)
        return used[0], used[1]

    def _columns(self, starts: Sequence[Start], t: Times, counts: Array, offsets: Array) -> batch.Sweep:
        """The starts as arrays; one encoder for all where it does not see ℬ."""
        origins = [self._origin(start) for start in starts]
        same = all(origin.encoder is origins[0].encoder for origin in origins)
        encoders = np.array([origin.encoder for origin in (origins[:1] if same else origins)])
        which = np.zeros(len(starts), np.int64) if same else np.arange(len(starts))
        columns = (np.array(column) for column in list(zip(*origins, strict=True))[1:])
        b, anchor, initial, terminal, velocity, pace = columns
        return batch.Sweep(encoders, which, b, anchor, initial, terminal, velocity, pace, t, counts, offsets)

    def _work(self, dtype: type) -> tuple[batch.Work, batch.Lanes]:
        """Memory and networks for a sweep in this precision, made at the first."""
        if dtype not in self._works:
            own, lanes = self._tables[2], batch.LANES
            n, widest = len(own.rates.signs_out), max(int(own.rates.widths.max()), len(own.rates.signs_out))
            rates, decoder = cast(own.rates, dtype), cast(own.decoder, dtype)
            modes: Array = own.modes.astype(dtype)
            latent, raw, layers = (
                np.empty(shape, dtype) for shape in ((lanes, self.latent_dim), (lanes, n), (2, 2 * lanes * widest))
            )
            work = batch.Work(rates, decoder, modes, latent, raw, layers, self._scratch(2, dtype))
            self._works[dtype] = work, batch.lanes_for(work, lanes)
        return self._works[dtype]

    def _scratch(self, dim: int, dtype: type) -> Any:
        own = self._tables[dim]
        rank, width = own.modes.shape
        return scratch(cast(own.decoder, dtype), rank, width, len(own.rates.signs_out))

    def _require_counts(self, starts: Sequence[Start], interval: float, counts: Sequence[int]) -> None:
        for start in starts:
            self._require_shapes(start)
        if len(counts) != len(starts) or min(counts, default=1) < 1:
            raise InputError("counts: give one number of samples, at least 1, for each start")
        if not interval > 0:
            raise InputError(f"interval={interval:g} is not allowed: give a time above 0")

    def _require_memory(self, out: Array, shape: tuple[int, ...], dtype: type) -> None:
        if out.shape != shape or out.dtype != dtype or not out.flags.c_contiguous:
            raise InputError(f"out: give a contiguous array of shape {shape} and type {np.dtype(dtype)}")


def load_compiled(folder: str | Path, rtol: float = RTOL, atol: float = ATOL) -> CompiledModel:
    """The model of a folder such as ``results/models/forecast``; raises InputError for anything else."""
    return load(CompiledModel, folder, rtol, atol)


def _require_done(status: int, when: float, start: Start) -> None:
    """Raise NumericalError for an integration that failed."""
    if status != DONE:
        raise left_the_numbers(start) if status == NOT_FINITE else stuck(start, when)
