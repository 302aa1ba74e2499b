"""Starts on a knife's edge: exactly symmetric, all but symmetric, exactly vertical."""

from collections.abc import Iterable
from itertools import product
from math import pi

import numpy as np

from sedfiber.core.array_types import History
from sedfiber.physics.integrators import Radau, Tolerances
from sedfiber.scene.assembly import assemble
from sedfiber.scene.numerics import Numerics
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance, rms_distance
from sedfiber.simulation.equilibria.spectrum import spectrum
from sedfiber.simulation.equilibria.vertical import vertical_shape
from sedfiber.simulation.run import simulate
from sedfiber.study.hard_cases.case import Measurement, yes_or_no

EXPECTED = {4000.0: "U", 7000.0: "U", 10000.0: "W"}
METHODS = ("LSODA", "BDF", "Radau")
TOLERANCES = (1e-8, 1e-10)
_STILL_SYMMETRIC = 1e-6  # a: while round-off has not grown further, the whole fiber tells how it should move
_GROWTH = (1e-5, 1e-3)  # a: sideways displacement between which buckling follows one mode


def exactly_symmetric() -> Iterable[Measurement]:
    """θ₀ = 0 without a tilt: the symmetry holds to the end, and the end has a name."""
    for B, name in EXPECTED.items():
        run = simulate(Scene(B, 0.0, tilt=0.0))
        yield Measurement(f"B={B:g}: largest asymmetry, a", asymmetry(run.shape).max(), 1e-9)
        end = run.metadata["settled_to"]
        yield yes_or_no(f"B={B:g}: settles to the {name}", end == name, f"settled to {end}")
        yield yes_or_no(
            f"B={B:g}: has a settling time if it is a U, and none if not", (name == "U") == bool(run.settling_time)
        )
        whole = _whole_fiber(B, len(run.t))
        samples = int(np.argmax(asymmetry(whole) > _STILL_SYMMETRIC)) or len(whole)
        apart = largest_distance(run.shape[:samples], whole[:samples], 62.0)
        words = f"B={B:g}: distance from the whole fiber by Radau at 1e-11 until t={(samples - 1) / 2:g}, L"
        yield Measurement(words, apart, 1e-5)


def asymmetry(shapes: History) -> np.ndarray:
    """Largest distance (T,) in a between a bead and the mirror image of its partner; shapes (T, N, 3)."""
    image = shapes[:, ::-1] * np.array([-1.0, 1.0, 1.0])
    return np.linalg.norm(shapes - image, axis=2).max(axis=1)


def _whole_fiber(B: float, samples: int) -> History:
    """The same fall with all beads as unknowns, which round-off makes asymmetric in time; shapes (T, N, 3)."""
    scene = Scene(B, 0.0, tilt=0.0)
    system = assemble(scene)
    states = Radau(system, Tolerances(1e-11, 1e-11)).states(system.to_state(scene.start()), 0.5)
    return system.to_shapes(np.array([next(states) for _ in range(samples)]))


def all_but_symmetric() -> Iterable[Measurement]:
    """θ₀ = 0 with the study's tilt: three methods at two tolerances tell one history."""
    for B in EXPECTED:
        scene = Scene(B, 0.0)
        end = float(simulate(scene).t[-1])
        ways = product(METHODS, TOLERANCES)
        runs = [simulate(scene, Numerics(name, rtol, rtol), end).positions for name, rtol in ways]
        spread = max(largest_distance(one, other, scene.length) for one in runs for other in runs)
        yield Measurement(f"B={B:g}: spread over three methods and two tolerances, L", spread, 1e-3)
        reference = simulate(scene, Numerics("Radau", 1e-12, 1e-12), end).positions
        apart = max(rms_distance(run, reference, scene.length).max() for run in runs)
        yield Measurement(f"B={B:g}: largest distance from Radau at 1e-12, L", apart, 1e-3)


def exactly_vertical() -> Iterable[Measurement]:
    """θ₀ = π/2 falls straight; 1e-8 rad from it the fiber buckles at the rate of the vertical state's mode."""
    for B in (100.0, 1000.0, 10000.0):
        straight = simulate(Scene(B, pi / 2), t_end=400.0)
        yield Measurement(f"B={B:g}: largest sideways displacement, a", np.abs(straight.positions[..., 0]).max(), 0.0)
        scene = Scene(B, pi / 2 - 1e-8)
        predicted = spectrum(scene, vertical_shape(scene)).in_plane_rate
        run = simulate(scene, Numerics(rtol=1e-12, atol=1e-12), t_end=20.0 / predicted)
        measured = _buckling_rate(run.t, np.abs(run.shape[..., 0]).max(axis=1))
        words = f"B={B:g}: buckling rate against {predicted:.5g} U_s/a, relative"
        yield Measurement(words, abs(measured / predicted - 1.0), 0.01)


def _buckling_rate(t: np.ndarray, sideways: np.ndarray) -> float:
    """Slope of the logarithm of the sideways displacement where one mode is left and it is small."""
    linear = (sideways > _GROWTH[0]) & (sideways < _GROWTH[1])
    return float(np.polyfit(t[linear], np.log(sideways[linear]), 1)[0])
