"""A tiny settling fiber with a known history: it rotates to horizontal and bends to a U."""

import numpy as np

from sedfiber.reduced.dataset import Dataset, SettlingFall
from sedfiber.simulation.trajectory import fall_keys

N_BEADS = 5
TRAINED = (100.0, 300.0, 1000.0)
NAMES = [f"{axis}{bead}" for bead in range(N_BEADS) for axis in "xyz"]


def bent_fiber(angle, bend):
    """A U of depth ``bend`` turned by ``angle``, centre bead at 0: (T,) and (T,) to (T, N, 3)."""
    s = 2.0 * (np.arange(N_BEADS) - N_BEADS // 2)
    along, across = s[None], bend[:, None] * s[None] ** 2 / s[-1]
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = cos * along - sin * across, sin * along + cos * across
    return np.stack([x, y, np.zeros_like(x)], axis=-1)


def settling(B, angle_index, split="train", duration=12.0):
    """One trajectory: the angle decays at a rate of its own, the bend grows, the fiber falls."""
    theta0 = angle_index * np.pi / 48
    t = np.arange(0.0, duration + 0.25, 0.5)
    final_bend = 0.1 * np.log10(B)
    shapes = bent_fiber(theta0 * np.exp(-t / 3), final_bend * (1 - np.exp(-t)))
    centre = np.zeros((len(t), 3))
    centre[:, 0] = -0.3 * theta0 * (1 - np.exp(-t / 3))
    centre[:, 1] = -2.0 * t - theta0**2 * (1 - np.exp(-t / 2))
    terminal = bent_fiber(np.zeros(1), np.array([final_bend]))[0]
    velocity = np.array([0.0, -2.0, 0.0])
    positions = shapes + centre[:, None]
    keys = fall_keys(split, B, angle_index, theta0)
    return SettlingFall(t, positions, keys, terminal=terminal, terminal_velocity=velocity)


def training_set():
    """Three ℬ, four even angles."""
    return Dataset(tuple(settling(B, k) for B in TRAINED for k in (0, 6, 12, 18)))
