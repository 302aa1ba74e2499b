"""Tumbling in a shear: a rigid chain in plain NumPy, Jeffery's orbit, and a stiff fiber integrated in time."""

import functools
import itertools

import numpy as np
import pytest
from pygrpy.grpy_tensors import mu

import reference
from problems import straight_chain
from sedfiber.physics.bending import Bending
from sedfiber.physics.couple_flow import CoupleFlow
from sedfiber.physics.flow_couple import FlowCouple
from sedfiber.physics.integrators import INTEGRATORS, Tolerances
from sedfiber.physics.linear_flow import LinearFlow, named_gradient
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.stretching import Stretching
from sedfiber.physics.system import System

RATE = 0.05
N_BEADS = 11  # unless told

each_size = pytest.mark.parametrize("n_beads", [11, 31])


def turned(n_beads, theta):
    """A straight chain at the angle ``theta`` to the flow, about the origin, (N, 2)."""
    return straight_chain(n_beads, 2) @ np.array([[np.cos(theta), np.sin(theta)], [-np.sin(theta), np.cos(theta)]])


def rotlets(x, torque):
    """The flow (N, 2) at beads ``x`` of the same torque about z on the fluid by each: (3/4) T ẑ × r/r³."""
    r = x[:, None] - x
    dist = np.sqrt((r**2).sum(-1)) + np.eye(len(x))
    return (0.75 * torque * np.stack([-r[..., 1], r[..., 0]], -1) / dist[..., None] ** 3).sum(1)


def rigid_rate(theta, n_beads, with_rotlets=True):
    """θ̇/rate of a rigid straight chain: all of ``U + θ̇ ẑ × r − u∞`` dragged, no force and no torque in sum.

    The drag is the inverse of RPY; each bead feels (4/3)(ω∞ − Ω) with Ω = t × G t besides, and
    ``u∞`` includes the flow of the opposite torques.
    """
    x = turned(n_beads, theta)
    friction = np.linalg.inv(reference.rpy(x))
    gradient = np.array([[0.0, 1.0], [0.0, 0.0]])
    motions = np.zeros((n_beads, 2, 3))  # along x, along y, about z
    motions[:, 0, 0] = motions[:, 1, 1] = 1.0
    motions[:, 0, 2], motions[:, 1, 2] = -x[:, 1], x[:, 0]
    motions = motions.reshape(-1, 3)
    t = np.array([np.cos(theta), np.sin(theta)])
    passive = t[0] * (gradient @ t)[1] - t[1] * (gradient @ t)[0]
    couple = 4 / 3 * (-0.5 - passive)
    flow = x @ gradient.T + (rotlets(x, -couple) if with_rotlets else 0.0)
    pull = motions.T @ friction @ flow.ravel() + [0, 0, n_beads * couple]
    return np.linalg.solve(motions.T @ friction @ motions, pull)[2]


@functools.cache
def aspect_ratio(n_beads, with_rotlets=True):
    """``r_e`` of Jeffery's spheroid that turns as fast as the rigid chain across and along the flow."""
    across, along = (rigid_rate(theta, n_beads, with_rotlets) for theta in (np.pi / 2, 0.0))
    return np.sqrt(across / along)


def multipole_ratio(n_beads):
    """The same of a rigid chain in pygrpy's Rotne–Prager mobility for forces and torques (Zuk et al. 2014)."""
    x = straight_chain(n_beads)
    friction = np.linalg.inv(mu(x, np.ones(n_beads)))

    def motion(across, turning):
        """All beads' velocities, then all angular velocities: across the chain and about z."""
        v = np.zeros((2, n_beads, 3))
        v[0, :, 1], v[1, :, 2] = across, turning
        return v.ravel()

    spin = motion(x[:, 0], 1.0)
    along, across = motion(0 * x[:, 0], -0.5), motion(-x[:, 0], -0.5)
    return np.sqrt((spin @ friction @ across) / (spin @ friction @ along))


def integrated(theta, interval, count, n_beads=N_BEADS, with_couple=True, flow="shear"):
    """Shapes (count, N, 2) of a stiff fiber (ℬ = 1) in a flow every ``interval``, at first straight at ``theta``."""
    modulus = 24.0 * n_beads**3
    flow = LinearFlow(named_gradient(flow, RATE))
    forces, mobility = [Stretching(modulus), Bending(modulus)], PairMobility("RPY", 2)
    nonconservative, flows = (
        ([FlowCouple(flow, n_beads)], [flow, CoupleFlow(flow, n_beads)]) if with_couple else ([], [flow])
    )
    system = System(forces, mobility, n_beads, 2, nonconservative=nonconservative, flows=flows)
    integrator = INTEGRATORS["LSODA"](system, Tolerances(1e-7, 1e-7))  # smaller ones drown in round-off at N = 31
    states = integrator.states(system.to_state(turned(n_beads, theta)), interval)
    return system.to_positions(np.array(list(itertools.islice(states, count))))[..., :2]


def angles(shapes):
    """Angles of the line from end to end of shapes (T, N, 2), without jumps."""
    ends = shapes[:, -1] - shapes[:, 0]
    return np.unwrap(np.arctan2(ends[:, 1], ends[:, 0]))


@each_size
def test_rigid_chain_follows_jeffery(n_beads):
    """θ̇ = −rate (r_e² sin²θ + cos²θ)/(r_e² + 1) at every angle: exact, as all of it is quadratic in t."""
    ratio = aspect_ratio(n_beads)
    theta = np.linspace(0, np.pi, 37)
    jeffery = -(ratio**2 * np.sin(theta) ** 2 + np.cos(theta) ** 2) / (ratio**2 + 1)
    found = np.array([rigid_rate(angle, n_beads) for angle in theta])
    print(f"N = {n_beads}: r_e = {ratio:.6f}, off Jeffery by {np.abs(found - jeffery).max():.1e} rate")
    assert np.abs(found - jeffery).max() < 1e-12


@each_size
def test_aspect_ratio_against_slender_bodies(n_beads):
    """r_e is 1.02 to 1.12 of Cox's (1971) 1.24 N/√ln N for a blunt cylinder, and 1.04 to 1.06 of that of a
    rigid chain in Rotne–Prager multipoles up to the torque; with stresslets these give 9.092 and 23.080,
    less than 1 % more than here.  Without the rotlets it would be 0.69 of Cox's.
    """
    ratio, multipoles = aspect_ratio(n_beads), multipole_ratio(n_beads)
    alone, stresslets = aspect_ratio(n_beads, with_rotlets=False), {11: 9.092, 31: 23.080}[n_beads]
    cox = 1.24 * n_beads / np.sqrt(np.log(n_beads))
    print(
        f"N = {n_beads}: r_e = {ratio:.4f}, without rotlets {alone:.4f}, multipoles to the torque {multipoles:.4f}"
        f" and to the stresslet {stresslets}, Cox {cox:.4f}"
    )
    assert 1.02 < ratio / cox < 1.12
    assert 1.04 < ratio / multipoles < 1.06
    assert 0.99 < ratio / stresslets < 1.0
    assert alone / cox == pytest.approx(0.69, abs=0.01)


@each_size
def test_stiff_fiber_tumbles_with_jeffery_period(n_beads):
    """Half a turn of the integrated fiber takes half of 2π (r_e + 1/r_e)/rate within 2 %, and it stays straight."""
    ratio = aspect_ratio(n_beads)
    period = 2 * np.pi * (ratio + 1 / ratio) / RATE
    interval = period / 1000
    shapes = integrated(np.pi / 2, interval, 550, n_beads)
    assert np.abs(reference.bond_lengths(shapes) / 2 - 1).max() < 1e-3
    theta = angles(shapes)
    assert (np.diff(theta) < 0).all()
    assert theta[-1] < -np.pi / 2
    measured = 2 * np.interp(np.pi / 2, -theta, interval * np.arange(len(theta)))
    print(f"N = {n_beads}: period {measured:.3f}, Jeffery {period:.3f}, off by {measured / period - 1:.1e}")
    assert measured == pytest.approx(period, rel=0.02)


def test_without_the_couple_no_fiber_turns_past_alignment():
    """From 0.2 rad it follows a line of fluid, tan θ = tan θ₀/(1 + rate t tan θ₀), in a time after which
    the same fiber with the couple is upside down.
    """
    interval = 2 * np.pi * aspect_ratio(N_BEADS) / RATE / 100
    alone = angles(integrated(0.2, interval, 100, with_couple=False))
    turned_over = angles(integrated(0.2, interval, 100))
    start, time = np.tan(0.2), interval * np.arange(100)
    assert (alone > 0).all()
    assert alone == pytest.approx(np.arctan(start / (1 + RATE * time * start)), rel=5e-3)
    assert turned_over[-1] < -np.pi / 2


def test_fiber_turns_with_a_rotating_fluid():
    """Neither couples nor rotlets act where nothing is strained: straight, of one length, at the fluid's rate."""
    interval = 2 * np.pi / RATE / 20
    shapes = integrated(0.3, interval, 41, flow="rotation")
    assert np.abs(reference.bond_lengths(shapes) / 2 - 1).max() < 1e-6
    assert angles(shapes) == pytest.approx(0.3 + RATE * interval * np.arange(41), abs=1e-5)
    ends = (shapes[:, -1] - shapes[:, 0]) / (2 * (N_BEADS - 1))
    normal = np.stack([-ends[:, 1], ends[:, 0]], -1)
    assert np.abs(((shapes - shapes[:, :1]) * normal[:, None]).sum(-1)).max() < 1e-5
