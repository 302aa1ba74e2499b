"""Stiff and floppy fibers against another method at tighter tolerances."""

from collections.abc import Iterable
from functools import partial
from math import pi

from sedfiber.scene.numerics import Numerics
from sedfiber.scene.parts import Contact
from sedfiber.scene.scene import Scene
from sedfiber.simulation.checks import ENERGY_BALANCE
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.run import simulate
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.angles import angle_of
from sedfiber.study.hard_cases.case import Measurement, must_refuse, yes_or_no

TIGHT = Numerics("Radau", rtol=1e-10, atol=1e-10)
AGREE = 1e-4  # of L
THREE_ANGLES = (4, 12, 20)  # k in θ₀ = k π/48
WHILE = 600.0  # a/U_s: fibers too floppy for a terminal shape never settle


def stiffest() -> Iterable[Measurement]:
    """ℬ = 100 and the steepest start of the study, then 10 and 1 with ever slower rotation."""
    for B, interval, method in ((100.0, 0.5, "Radau"), (10.0, 5.0, "Radau"), (1.0, 20.0, "BDF")):
        run = simulate(Scene(B, angle_of(22)), Numerics(interval=interval))
        yield from _against(run, Numerics(method, 1e-10, 1e-10, interval), f"B={B:g}, k=22")


def floppiest_of_the_study() -> Iterable[Measurement]:
    """ℬ = 10000 at all 23 angles of the study's grid."""
    worst, imbalance = 0.0, 0.0
    for k in range(23):
        found = list(_against(simulate(Scene(10000.0, angle_of(k))), TIGHT, ""))
        worst, imbalance = max(worst, found[0].value), max(imbalance, found[1].value)
    yield Measurement("largest distance from Radau at 1e-10 over all angles, L", worst, AGREE)
    yield Measurement("largest energy imbalance over all angles", imbalance, ENERGY_BALANCE)


def beyond_the_U() -> Iterable[Measurement]:
    """ℬ = 1e5 and 1e6: no U exists; with contact, without it, and with the mobility that does not stand it."""
    for B in (1e5, 1e6):
        for k in THREE_ANGLES:
            scene = Scene(B, angle_of(k), hydrodynamics="RPY-overlap", contact=Contact())
            yield from _against(simulate(scene, t_end=WHILE), TIGHT, f"B={B:g}, k={k}, contact and overlap form")
    loose = simulate(Scene(1e6, pi / 4, hydrodynamics="RPY-overlap"), t_end=WHILE)
    missed = any(verdict["effect"] == "contact" and verdict["matters"] for verdict in loose.metadata["audit"])
    yield yes_or_no("B=1e6 without contact: the audit says that it matters", missed)
    collapse = partial(simulate, Scene(1e6, pi / 4), t_end=WHILE)
    yield must_refuse("B=1e6 with plain RPY: refused, naming the pair", collapse, "not positive definite", "beads")
    endless = partial(simulate, Scene(1e5, pi / 4))
    yield must_refuse("B=1e5 without an end: refused, naming the fold", endless, "ends in a fold", "--t-end")


def _against(run: Trajectory, numerics: Numerics, words: str) -> Iterable[Measurement]:
    """Distance from the same run by other numerics, and its own energy balance."""
    scene = scene_of(run)
    second = simulate(scene, numerics, t_end=float(run.t[-1]))
    apart = largest_distance(run.positions, second.positions, scene.length)
    yield Measurement(f"{words}: distance from {numerics.integrator} at {numerics.rtol:g}, L", apart, AGREE)
    yield Measurement(f"{words}: energy imbalance", run.metadata["checks"]["energy_imbalance"], ENERGY_BALANCE)


def scene_of(run: Trajectory) -> Scene:
    """The scene that a run's metadata record."""
    return Scene.from_dict({key: value for key, value in run.metadata["scene"].items() if key != "start_angle"})
