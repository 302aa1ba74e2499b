"""Runs that go far: out of the plane, and down by a million bead radii."""

from collections.abc import Iterable
from functools import partial
from math import pi

import numpy as np

from sedfiber.scene.numerics import Numerics
from sedfiber.scene.parts import Disturbance, Fiber
from sedfiber.scene.scene import Scene
from sedfiber.simulation.differences import largest_distance
from sedfiber.simulation.equilibria.plane_stability import out_of_plane, watch
from sedfiber.simulation.equilibria.spectrum import spectrum
from sedfiber.simulation.equilibria.steady import terminal_state
from sedfiber.simulation.run import simulate
from sedfiber.study.hard_cases.case import Measurement, must_refuse, yes_or_no

OUT = 1e-4  # a: displacement out of the plane at the start
FALL = 1e6  # a


def out_of_the_plane() -> Iterable[Measurement]:
    """1e-4 a out of the plane: the fiber returns to it at ℬ = 3000 and leaves it at 10000."""
    for B, t_end in ((3000.0, 4000.0), (10000.0, 1200.0)):
        scene = Scene(B, pi / 4, space="volume", disturbance=Disturbance(OUT))
        state = terminal_state(scene)
        predicted = spectrum(scene, state.positions).out_of_plane_rate
        growth = watch(scene, OUT, t_end)
        words = f"B={B:g}: out-of-plane rate against {predicted:.4g} U_s/a, relative"
        yield Measurement(words, abs(growth.rate / predicted - 1.0), 0.01)
        if predicted < 0.0:
            yield Measurement(f"B={B:g}: distance from a vertical plane at t={t_end:g}, a", growth.amplitude[-1], 1e-6)
            continue
        run = simulate(scene, t_end=t_end)
        left = out_of_plane(run.shape)[0].max()
        yield yes_or_no(f"B={B:g}: gets further than 1 a from a vertical plane", left > 1.0, f"{left:.3g} a")
        unnamed = run.metadata["settled_to"] is None and run.settling_time is None
        yield yes_or_no(f"B={B:g}: not called settled", unnamed)
        endless = partial(simulate, scene)
        yield must_refuse(f"B={B:g} without an end: refused, with the rate", endless, "unstable", "--t-end")


def fall_of_a_million() -> Iterable[Measurement]:
    """A terminal shape falls 1e6 a: the shape after is the shape before; and a fall far off is one near by."""
    for B in (100.0, 10000.0):
        state = terminal_state(Scene(B, 0.0))
        scene = Scene(B, 0.0, shape=state.positions.tolist())
        steps = 1000.0 / state.speed
        run = simulate(scene, Numerics(interval=steps), t_end=1.001 * FALL / state.speed)
        fall = run.centre[0, 1] - run.centre[-1, 1]
        yield yes_or_no(f"B={B:g}: falls 1e6 a", fall >= FALL, f"{fall:.6g} a")
        yield Measurement(f"B={B:g}: shape after from shape before, L", _change(run.shape), 1e-8)
        expected = state.speed * run.t[-1]
        yield Measurement(f"B={B:g}: fall against speed times time, relative", abs(fall / expected - 1.0), 1e-9)
        places = (Scene(B, pi / 4, fibers=(Fiber(place=(0.0, y)),)) for y in (0.0, -FALL))
        near, far = (simulate(place, Numerics(rtol=1e-11, atol=1e-11), 300.0) for place in places)
        apart = largest_distance(near.shape, far.shape, scene.length)
        yield Measurement(f"B={B:g}: shapes of a fall that starts at y=-1e6 a from one at 0, L", apart, 1e-8)


def _change(shapes: np.ndarray) -> float:
    return largest_distance(shapes[-1:], shapes[:1], 2.0 * shapes.shape[1])
