"""Runs with thermal noise: repetition, seeds, counters, and what is rejected."""

from itertools import islice

import numpy as np
import pytest

import reference
from sedfiber import InputError, NumericalError, Numerics, simulate
from sedfiber.scene.assembly import assemble
from thermal import LinearMotion, chain_scene, displacements, integrator_of

NOISY = chain_scene(5, seed=7)


def test_a_run_repeats_and_its_seed_counts():
    """Same seed, same bytes; another seed, other bytes; file metadata name seed and integrator."""
    runs = [simulate(NOISY, t_end=2.0), simulate(NOISY, t_end=2.0)]
    assert runs[0].positions.tobytes() == runs[1].positions.tobytes()
    assert runs[0].metadata == runs[1].metadata
    assert runs[0].metadata["scene"]["seed"] == 7
    assert runs[0].metadata["scene"]["noise"] == {"peclet": 1.0, "step": 0.01}
    assert runs[0].metadata["numerics"]["integrator"] == "stochastic-midpoint"
    other = simulate(chain_scene(5, seed=8), t_end=2.0)
    assert np.array_equal(other.positions[0], runs[0].positions[0])
    assert not (other.positions[1:] == runs[0].positions[1:]).all(axis=(1, 2)).any()


def test_the_start_and_the_noise_draw_different_numbers():
    """The noise is not the stream that the seed itself begins, from which the start's disturbance is drawn.

    One step of a free bead is √(2kTΔt) times three normal numbers.
    """
    system = assemble(chain_scene(1, space="volume", hydrodynamics="none"))
    moves = displacements(system, np.zeros((1, 3)), 1.0, 1, seed=7, step=0.5)[0]
    assert np.abs(moves - np.random.default_rng(7).standard_normal(3)).min() > 1e-6


def test_counters_count_the_steps():
    """Two time units at step 0.01: 200 steps, each with one velocity, one Jacobian and two factorisations."""
    counters = simulate(NOISY, t_end=2.0).metadata["counters"]
    assert counters == {"steps": 200, "rhs": 200, "jacobians": 200, "factorisations": 400}


def test_samples_do_not_depend_on_their_spacing():
    """The same steps sampled every 5 and every 50 of them, to round-off."""
    fine, coarse = (simulate(NOISY, Numerics(interval=tau), t_end=2.0) for tau in (0.05, 0.5))
    assert np.abs(fine.positions[::10] - coarse.positions).max() < 1e-10


@pytest.mark.parametrize(
    ("scene", "numerics", "key"),
    [
        (NOISY, Numerics("LSODA"), "integrator"),
        (chain_scene(5, noise=None), Numerics("stochastic-midpoint"), "integrator"),
        (chain_scene(5, noise={"peclet": 1.0, "step": 0.03}), Numerics(), "noise.step"),
        (chain_scene(5, noise={"peclet": 1.0, "step": 1.0}), Numerics(), "noise.step"),
        (chain_scene(5, noise={"peclet": 1e-3, "step": 0.5}), Numerics(), "noise.step"),
    ],
    ids=["deterministic integrator", "no noise", "step does not divide", "step too long", "bonds too warm"],
)
def test_what_does_not_fit_noise_is_refused(scene, numerics, key):
    """One line that begins with the key."""
    with pytest.raises(InputError, match=f"^{key}: .* give ") as error:
        simulate(scene, numerics, t_end=2.0)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), "hot"])
@pytest.mark.parametrize("key", ["peclet", "step"])
def test_noise_without_sense_is_refused(key, value):
    """Péclet number and step are positive numbers."""
    with pytest.raises(InputError, match=rf"^noise\.{key}: "):
        chain_scene(5, noise={"peclet": 1.0, "step": 0.01} | {key: value})


def test_a_mobility_that_is_not_positive_is_refused():
    """Plain RPY for two beads 1.0 apart has the eigenvalue 1 − c1 = −0.25, and no square root."""
    system = assemble(chain_scene(3, hydrodynamics="RPY"))
    x = np.array([[0.0, 0.0], [1.0, 0.0], [4.0, 0.0]])
    assert np.linalg.eigvalsh(reference.rpy(x)).min() < 0
    with pytest.raises(NumericalError, match=r"^stochastic-midpoint: .* at t = 0 .*RPY-overlap") as error:
        displacements(system, x, 1.0, 1, seed=1)
    assert "\n" not in str(error.value)


@pytest.mark.filterwarnings("ignore")
def test_positions_that_are_not_finite_are_refused():
    """A force that is not a number ends the integration in the very step, and its remedy is the noise's."""
    motion = LinearMotion(np.eye(2), np.eye(2))
    motion.velocity_jacobian = lambda x: np.full((2, 2), np.nan if x.any() else 0.0)
    with pytest.raises(NumericalError, match=r"^stochastic-midpoint: .*not finite at t = 0.2 .*noise\.step"):
        list(islice(integrator_of(motion, 1.0, 0.1, seed=1).states(np.zeros(2), 1.0), 2))
