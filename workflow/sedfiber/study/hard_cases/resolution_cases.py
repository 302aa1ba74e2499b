"""Few beads and many: what converges as beads are added, how fast, and at what cost."""

import resource
import time
from collections.abc import Iterable
from math import pi

import numpy as np
from scipy.optimize import minimize_scalar

from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.hard_cases.case import Measurement

LADDER = (3, 5, 11, 61, 101, 301)
B = 100.0
ORDER = 1.0  # of 1/N: each end of the chain is half a bead off
_MEASURED = slice(2, 5)  # rungs that the order is read from; fewer beads are no fiber, and the last is the reference
_RELAXED = 0.4  # a/U_s a bead: about one relaxation time of the slowest bend, which is proportional to ℬ N
_ANGLE = 2.0  # radians through which the relaxing arc turns
_RESAMPLED = np.linspace(-0.5, 0.5, 21)  # along the fiber, over its length


def beads() -> Iterable[Measurement]:
    """A relaxing arc converges with its beads at order 1; the fall's slow drift is that of its slenderness."""
    shapes = [_relaxed_arc(n) for n in LADDER]
    apart = np.array([np.sqrt(((shape - shapes[-1]) ** 2).sum(axis=1).mean()) for shape in shapes[:-1]])
    order = _order(np.array(LADDER[_MEASURED], dtype=float), apart[_MEASURED])
    distances = ", ".join(f"{n}: {value:.2g}" for n, value in zip(LADDER, apart, strict=False))
    note = f"distance from N=301 over L, {distances}"
    yield Measurement(
        "relaxing arc: largest ratio of one rung's distance to the last's", _worst_ratio(apart), 1.0, note
    )
    yield Measurement(
        f"relaxing arc: order of convergence from {ORDER:g}", abs(order - ORDER), 0.1, f"order {order:.3f}"
    )
    yield from _falls()


def _falls() -> Iterable[Measurement]:
    """ℬ = 100 from π/4: settling time a bead, and the speed's growth with the logarithm of the slenderness."""
    before = time.perf_counter()
    runs = [simulate(Scene(B, pi / 4, n)) for n in LADDER]
    seconds = time.perf_counter() - before
    times = np.array([(run.settling_time or np.nan) / n for run, n in zip(runs, LADDER, strict=True)])
    apart = np.abs(times[1:-1] - times[-1])
    listed = ", ".join(f"{n}: {value:.4g}" for n, value in zip(LADDER, times, strict=True))
    yield Measurement(
        "fall: largest ratio of one rung's T/N from the last's", _worst_ratio(apart), 1.0, f"T/N, {listed}"
    )
    yield Measurement("fall: largest energy imbalance", max(map(_imbalance, runs)), 1e-4)
    few, many = (terminal_state(Scene(B, 0.0, n)).speed for n in (101, 301))
    growth = (many - few) / np.log(301 / 101)
    yield Measurement("dU/d ln N from slender-body theory's 3/4, relative", abs(growth / 0.75 - 1.0), 0.02)
    yield Measurement("seconds for the whole ladder", seconds, 300.0, "N=301 takes most of them")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    yield Measurement("peak memory of the process, MB", peak, 2000.0)


def _relaxed_arc(n: int) -> np.ndarray:
    """An arc of ``n`` beads that straightens without gravity or hydrodynamics for one relaxation time, over L.

    Points at fixed places along the fiber, its middle at the origin, (21, 2).
    """
    turned = _ANGLE * (np.arange(n - 1) - (n - 2) / 2) / n
    bonds = 2.0 * np.column_stack([np.cos(turned), np.sin(turned)])
    arc = np.vstack([np.zeros(2), np.cumsum(bonds, axis=0)])
    scene = Scene(B, 0.0, n, hydrodynamics="none", gravity=None, shape=arc - arc[n // 2])
    t_end = _RELAXED * n
    run = simulate(scene, Numerics(rtol=1e-7, atol=1e-7, interval=t_end), t_end=t_end)
    x = run.shape[-1, :, :2] / scene.length
    places = (np.arange(n) - n // 2) / n
    return np.column_stack([np.interp(_RESAMPLED, places, x[:, k]) for k in range(2)])


def _order(beads: np.ndarray, apart: np.ndarray) -> float:
    """p of ``apart = C (N^{−p} − M^{−p})``, M the finest, whose own error the distances contain."""

    def scatter(p: float) -> float:
        return float(np.std(np.log(apart) - np.log(beads**-p - LADDER[-1] ** -p)))

    return float(minimize_scalar(scatter, bounds=(0.2, 4.0), method="bounded").x)


def _worst_ratio(apart: np.ndarray) -> float:
    return float((apart[1:] / apart[:-1]).max())


def _imbalance(run: Trajectory) -> float:
    return run.metadata["checks"]["energy_imbalance"]
