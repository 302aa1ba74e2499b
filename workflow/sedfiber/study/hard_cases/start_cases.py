"""Starts that other programs stumble over: beads in each other, crumpled fibers, files full of nonsense."""

import tempfile
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from sedfiber.core.array_types import Positions
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.parts import Contact
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.study.hard_cases.case import Measurement, must_refuse, yes_or_no

APART = (1.9, 1.0, 0.1)  # a, between the two ends of a ring
SEEDS = range(50)
_RING = 11  # beads
_CRUMPLED = 31


def overlapping_beads() -> Iterable[Measurement]:
    """An open ring whose ends are 1.9, 1.0, 0.1 and 0 a apart, with both forms of the mobility."""
    for r in APART:
        scene = Scene(1000.0, 0.0, _RING, hydrodynamics="RPY-overlap", shape=_ring(r))
        run = simulate(scene, t_end=100.0)
        tight = simulate(scene, Numerics("Radau", 1e-10, 1e-10), 100.0)
        apart = largest_distance(run.positions, tight.positions, scene.length)
        yield Measurement(f"{r:g} a, overlap form: distance from Radau at 1e-10, L", apart, 1e-4)
    run = simulate(Scene(1000.0, 0.0, _RING, shape=_ring(1.9)), t_end=100.0)
    yield yes_or_no(
        "1.9 a, plain RPY: still positive definite, and runs", run.metadata["checks"]["least_mobility"] > 0.0
    )
    for r in (1.0, 0.1):
        named = f"not positive definite for beads 0 and {_RING - 1}"
        yield must_refuse(f"{r:g} a, plain RPY: refused, naming the pair", _scene(_ring(r)), named)
    for form in ("RPY", "RPY-overlap", "none"):
        named = f"beads 0 and {_RING - 1} are in one place"
        words = f"two beads in one place, {form}: refused, naming them"
        yield must_refuse(words, _scene(_ring(0.0), hydrodynamics=form), named)


def _ring(gap: float) -> Positions:
    """A regular polygon of bonds 2 a, opened so that the first and the last bead are ``gap`` apart, (N, 2)."""
    # each bond turns by the same angle; n − 1 bonds span the chord 2 sin((n − 1) φ/2)/sin(φ/2)
    low, high = pi / _RING, 2.0 * pi / (_RING - 1)
    for _ in range(200):
        turn = 0.5 * (low + high)
        span = 2.0 * np.sin((_RING - 1) * turn / 2.0) / np.sin(turn / 2.0)
        low, high = (turn, high) if span > gap else (low, turn)
    angles = high * (np.arange(_RING - 1) - (_RING - 2) / 2)
    bonds = 2.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    x = np.vstack([np.zeros(2), np.cumsum(bonds, axis=0)])
    if gap == 0.0:
        x[-1] = x[0]
    return x - x[_RING // 2]


def _scene(shape: object, **changes: Any) -> Callable[[], Scene]:
    return partial(Scene, 1000.0, 0.0, _RING, shape=shape, **changes)


def crumpled() -> Iterable[Measurement]:
    """Fifty random walks of 31 beads in volume, with contact and the overlap form: each settles to the U."""
    not_finite, rises, settled = 0, -np.inf, 0
    for seed in SEEDS:
        scene = Scene(
            1000.0, 0.0, _CRUMPLED, "volume", "RPY-overlap", contact=Contact(), shape=random_walk(seed, _CRUMPLED)
        )
        run = simulate(scene)
        system = assemble(scene)
        energy = np.array([system.energy(x) for x in run.positions])
        not_finite += int(not np.isfinite(run.positions).all())
        rises = max(rises, float(np.diff(energy).max()))
        settled += int(run.metadata["settled_to"] == "U")
    yield Measurement("runs with a position that is not finite", not_finite, 0)
    yield Measurement("largest change of the energy from one sample to the next, 6πμa²U_s", rises, 0.0)
    yield Measurement("runs that do not settle to the U", len(SEEDS) - settled, 0)


def random_walk(seed: int, n_beads: int) -> Positions:
    """Bonds of 2 a in independent directions: beads lie in one another at will; centre bead at the origin, (N, 3)."""
    bonds = np.random.default_rng(seed).normal(size=(n_beads - 1, 3))
    bonds *= 2.0 / np.linalg.norm(bonds, axis=1, keepdims=True)
    x = np.vstack([np.zeros(3), np.cumsum(bonds, axis=0)])
    return x - x[n_beads // 2]


def nonsense_starts() -> Iterable[Measurement]:
    """NaN, infinities, nothing, too few or too many beads or coordinates, text; as values and as files."""
    good = _ring(2.0)
    bad = {
        "NaN": np.where(np.arange(_RING)[:, None] == 3, np.nan, good),
        "an infinity": np.where(np.arange(_RING)[:, None] == 3, np.inf, good),
        "empty": np.empty((0, 2)),
        "a bead too few": good[:-1],
        "a bead too many": np.vstack([good, good[-1] + 2.0]),
        "one coordinate": good[:, :1],
        "four coordinates": np.hstack([good, good]),
        "a plain number": np.array(1.0),
    }
    for name, shape in bad.items():
        yield must_refuse(f"{name}: refused in one line", _scene(shape.tolist()), "shape")
    with tempfile.TemporaryDirectory() as folder:
        for name, path in _bad_files(Path(folder), bad["NaN"]).items():
            found = must_refuse(f"{name}: refused in one line", _scene({"file": str(path)}), "shape")
            yield replace(found, note=found.note.replace(f"{folder}/", ""))  # the folder's name is random


def _bad_files(folder: Path, not_a_number: Positions) -> dict[str, Path]:
    texts = {"a file of words": "hello\nworld\n", "an empty file": "", "a ragged file": "0,0\n1\n2,2,2,2\n"}
    files = {name: folder / f"{k}.csv" for k, name in enumerate(texts)}
    for name, path in files.items():
        path.write_text(texts[name], encoding="utf-8")
    np.save(folder / "nan.npy", not_a_number)
    (folder / "cut.npy").write_bytes((folder / "nan.npy").read_bytes()[:100])
    return files | {
        "a file with NaN": folder / "nan.npy",
        "a file cut short": folder / "cut.npy",
        "no file": folder / "missing.csv",
    }
