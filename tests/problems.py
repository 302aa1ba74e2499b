"""Shared problems: shapes to evaluate forces on, and motions whose answer is known.

A motion is anything with ``rhs``, ``jacobian`` and their counters, which is all that an
integrator asks of a system.  Add a problem to ``MOTIONS`` and every integrator is run on it.
"""

import numpy as np

from sedfiber.physics.frame import no_band
from sedfiber.physics.free_draining import add_band
from sedfiber.physics.gravity import Gravity
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.physics.system import System
from sedfiber.scene.assembly import assemble
from sedfiber.scene.fields import HYDRODYNAMICS, SPACES
from sedfiber.scene.scene import Scene

SCENES = [(space, hydrodynamics) for space in SPACES for hydrodynamics in HYDRODYNAMICS]


def straight_chain(n_beads, dim=3, axis=0):
    """Touching beads at rest along one axis, centre bead at the origin."""
    x = np.zeros((n_beads, dim))
    x[:, axis] = 2.0 * (np.arange(n_beads) - n_beads // 2)
    return x


def bent_chain(seed, n_beads=11, dim=3, bend=0.25, stretch=0.03):
    """A smooth random chain: bond directions wander, bond lengths scatter about 2a."""
    rng = np.random.default_rng(seed)
    heading = rng.normal(size=dim) + bend * np.cumsum(rng.normal(size=(n_beads - 1, dim)), axis=0)
    bonds = heading / np.linalg.norm(heading, axis=1, keepdims=True)
    bonds *= 2.0 * (1.0 + stretch * rng.uniform(-1, 1, size=(n_beads - 1, 1)))
    x = np.vstack([np.zeros(dim), np.cumsum(bonds, axis=0)])
    return x - x[n_beads // 2]


def crumpled_chain(seed, n_beads=11, dim=3, closest=1.2):
    """A chain folded onto itself: some beads overlap, none nearer than ``closest``."""
    rng = np.random.default_rng(seed)
    x = None
    while x is None:
        x = _crumpled(rng, n_beads, dim, closest)
    return x - x[n_beads // 2]


def _crumpled(rng, n_beads, dim, closest):
    """One attempt, bead by bead; None where the end has wound itself in and finds no way on."""
    x = np.zeros((n_beads, dim))
    for m in range(1, n_beads):
        for _ in range(1000):  # redraw the bond until it keeps clear
            bond = rng.normal(size=dim)
            x[m] = x[m - 1] + 1.9 * bond / np.linalg.norm(bond)
            if np.linalg.norm(x[:m] - x[m], axis=1).min() > closest:
                break
        else:
            return None
    return x


def random_rotation(seed, dim):
    """A rotation matrix (d, d), uniform over all of them."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(dim, dim)))
    q *= np.sign(np.diag(r))
    q[:, 0] *= np.sign(np.linalg.det(q))
    return q


def system_of(space="plane", hydrodynamics="RPY", B=1000.0, n_beads=11):
    """The study's effects on a fiber of ``n_beads``; with Oseen too, which no scene of so many allows."""
    if hydrodynamics != "Oseen":
        return assemble(Scene(B, 0.5, n_beads, space=space, hydrodynamics=hydrodynamics))
    forces = assemble(Scene(B, 0.5, n_beads)).forces
    return System(forces, PairMobility("Oseen", SPACES[space]), n_beads, SPACES[space])


def force_of(effect, x):
    """The force of one effect alone, (N, d)."""
    force = np.zeros_like(x)
    effect.add_force(x, force)
    return force


def jacobian_of(effect, x):
    """Its Jacobian, (N d, N d)."""
    jac = np.zeros((x.size, x.size))
    if effect.banded:
        band = no_band(x.shape)
        effect.add_jacobian(x, band)
        add_band(band, jac)
    else:
        effect.add_jacobian(x, jac)
    return jac


def taylor_slope(f, jacobian, y, direction, eps):
    """Slope of ``log |f(y + ε v) − f(y) − ε J v|`` against ``log ε``: 2 for the true Jacobian."""
    linear = jacobian @ direction
    errors = [np.linalg.norm(f(y + e * direction) - f(y) - e * linear) for e in eps]
    return np.polyfit(np.log(eps), np.log(errors), 1)[0]


class Motion:
    """An equation ``ẏ = f(t, y)`` with a known solution, and the counters of a System."""

    name: str
    start: np.ndarray

    def __init__(self):
        self.rhs_count = self.jacobian_count = 0

    def loss_of_definiteness(self, y):
        return None  # no beads

    def rhs(self, t, y):
        self.rhs_count += 1
        return self.f(t, y)

    def jacobian(self, t, y):
        self.jacobian_count += 1
        return self.df(t, y)


class Oscillator(Motion):
    """``ẋ = v, v̇ = −x`` from (1, 0): a turn on the unit circle."""

    name, start = "oscillator", np.array([1.0, 0.0])

    def f(self, t, y):
        return np.array([y[1], -y[0]])

    def df(self, t, y):
        return np.array([[0.0, 1.0], [-1.0, 0.0]])

    def solution(self, t):
        return np.array([np.cos(t), -np.sin(t)])


class StiffTracking(Motion):
    """Prothero & Robinson 1974: ``ẏ = −λ (y − sin t) + cos t`` from 0, solved by ``sin t``."""

    name, start, rate = "stiff tracking", np.array([0.0]), 1e4

    def f(self, t, y):
        return -self.rate * (y - np.sin(t)) + np.cos(t)

    def df(self, t, y):
        return np.array([[-self.rate]])

    def solution(self, t):
        return np.array([np.sin(t)])


class Riccati(Motion):
    """``ẏ = −y²`` from 1, solved by ``1/(1 + t)``: a Jacobian that changes along the way."""

    name, start = "Riccati", np.array([1.0])

    def f(self, t, y):
        return -y * y

    def df(self, t, y):
        return np.array([-2.0 * y])

    def solution(self, t):
        return np.array([1.0 / (1.0 + t)])


class FallingPair(Motion):
    """Two free touching beads side by side fall without turning at ``1 + c1(2) = 1.4375``."""

    name = "falling pair"

    def __init__(self):
        super().__init__()
        self.system = System([Gravity()], PairMobility("RPY", 2), 2, 2)
        self.start = self.system.to_state(np.array([[0.0, 0.0], [2.0, 0.0]]))
        self.f, self.df = self.system.rhs, self.system.jacobian

    def solution(self, t):
        centre = self.system.centre
        y = self.start.copy()
        y[2 * centre + 1] -= 1.4375 * t
        y[-1] = 2 * 1.4375 * t  # the work of two unit weights
        return y


MOTIONS = [Oscillator, StiffTracking, Riccati, FallingPair]


def rms_distance(one, other, length):
    """Root-mean-square bead distance over L of two histories (T, N, 3), per sample."""
    return np.sqrt(((one - other) ** 2).sum(-1).mean(-1)) / length
