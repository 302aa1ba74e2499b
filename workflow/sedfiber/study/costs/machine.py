"""The machine of a time, and the unit by which the time carries over to another machine."""

import os
import platform
from collections.abc import Callable
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from math import pi
from pathlib import Path

from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene
from sedfiber.study.costs.timing import LEAST, REPEATS, timed

_PACKAGES = {"numpy": "NumPy", "scipy": "SciPy", "numba": "numba", "torch": "torch", "sedfiber": "sedfiber"}


def machine_columns() -> dict[str, str | float]:
    """The columns ``machine`` and ``rhs_unit_s`` that every table of costs has."""
    return {"machine": machine(), "rhs_unit_s": unit()}


def machine() -> str:
    """Processor, threads and versions, in one line."""
    threads = os.environ.get("OMP_NUM_THREADS", str(os.cpu_count()))
    versions = ", ".join(f"{name} {_version(package)}" for package, name in _PACKAGES.items())
    plural = "" if threads == "1" else "s"
    return f"{_processor()}, {threads} thread{plural}; Python {platform.python_version()}, {versions}"


def unit() -> float:
    """Seconds of one right-hand side of the study's scene, N = 31, at its start: the least of ten repeats."""
    return timed(_right_hand_side()).least


def calibrated_unit(seconds: float = 1.0) -> float:
    """The same, the least of as many repeats as take about so many seconds."""
    call = _right_hand_side()
    return timed(call, max(REPEATS, int(seconds / LEAST))).least


def _right_hand_side() -> Callable[[], object]:
    scene = Scene(1000.0, pi / 4)
    system = assemble(scene)
    return partial(system.rhs, 0.0, system.to_state(scene.start()))


def _version(package: str) -> str:
    """The version of an installed package; sedfiber may run from a checkout that is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def _processor() -> str:
    """The processor's name: of Linux's list where there is one."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or platform.machine()
