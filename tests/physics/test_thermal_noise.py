"""Thermal noise: fluctuation–dissipation, the drift of a varying mobility, and Boltzmann's distribution.

Expected numbers are closed forms, quadratures of Boltzmann factors, and the mobility of
``reference``.  Every seed is fixed, so a test has the same outcome in every run; tolerances are in
standard errors, which a long run takes from its own block averages.
"""

from itertools import islice

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import i0e, i1e

import reference
from problems import bent_chain
from sedfiber import InputError, NumericalError, Numerics, Scene, simulate
from sedfiber.physics.integrators import StochasticMidpoint, Tolerances
from sedfiber.physics.pair_mobility import PairMobility
from sedfiber.scene.assembly import assemble

MODULUS = 24.0  # ℰ of the chains below
DIMS = {"plane": 2, "volume": 3}

each_space = pytest.mark.parametrize("space", DIMS)


def integrator_of(system, temperature, step, seed):
    """The stochastic integrator; its tolerances mean nothing."""
    return StochasticMidpoint(system, Tolerances(1e-8, 1e-8), temperature, step, seed)


def chain_scene(n_beads, modulus=MODULUS, temperature=1.0, **parts):
    """A scene of fibers with the given ℰ, without gravity unless it is listed; kT is its noise's."""
    parts = {"gravity": None, "hydrodynamics": "RPY-overlap", "noise": {"peclet": 1.0 / temperature}} | parts
    return Scene(24.0 * n_beads**3 / modulus, 0.3, n_beads, **parts)


def block_average(values, blocks=20):
    """Mean over time, axis 0, and its standard error from blocks much longer than the correlation time."""
    values = values[: len(values) // blocks * blocks]
    means = values.reshape(blocks, -1, *values.shape[1:]).mean(1)
    return means.mean(0), means.std(0, ddof=1) / blocks**0.5


def sample_average(values):
    """Mean of independent draws, axis 0, and its standard error."""
    return values.mean(0), values.std(0, ddof=1) / len(values) ** 0.5


def deviation(measured, expected):
    """Largest distance of a mean from what is expected, in its standard errors."""
    mean, error = measured
    return np.abs((mean - expected) / error).max()


# --- one step: covariance and mean of the displacement ---

SHORT = 1e-5  # a step so short that its second order, about ℰ Δt, is below every statistical error
WALL = {"point": (0.0, -60.0, 0.0), "normal": (2 / 3, 2 / 3, 1 / 3)}
PLACES = {"plane": ("plane", None), "volume": ("volume", None), "near a wall": ("volume", WALL)}

each_place = pytest.mark.parametrize("place", PLACES)


def bent_chain_in(place):
    """Five beads with overlaps, and gravity, springs and bending: system and positions, the lowest 1.2 above a wall."""
    space, wall = PLACES[place]
    x = bent_chain(5, 5, DIMS[space], bend=0.6, stretch=0.15)
    scene = chain_scene(5, space=space, wall=wall, gravity={})
    if wall is not None:
        normal = np.array(WALL["normal"])
        x = x + (1.2 - ((x - np.array(WALL["point"])) @ normal).min()) * normal
    return assemble(scene), x


def mobility(place, system, x):
    """M from the reference; near a wall the package's own, which has tests of its own."""
    return system.mobility.matrix(x) if place == "near a wall" else reference.rpy(x, overlap=True)


def divergence(matrix_at, x, h=1e-5):
    """``∇·M``: ``Σ_k ∂M_ik/∂x_k`` by central differences, their error about h² and 1e-16/h."""
    total = np.zeros(x.size)
    for k in range(x.size):
        shift = np.zeros(x.size)
        shift[k] = h
        shift = shift.reshape(x.shape)
        total += (matrix_at(x + shift)[:, k] - matrix_at(x - shift)[:, k]) / (2 * h)
    return total


def displacements(system, x, temperature, n, seed, step=SHORT):
    """``n`` independent displacements (n, N d) over one step from ``x``."""
    integrator, start = integrator_of(system, temperature, step, seed), system.to_state(x)
    ends = np.array([next(islice(integrator.states(start, step), 1, None)) for _ in range(n)])
    return (system.to_positions(ends)[..., : x.shape[1]] - x).reshape(n, -1)


def drift_parts(system, x, temperature, n, seed):
    """Displacements over Δt, taken apart: (deterministic, linear noise, what is left).

    The same random numbers at 1e-8 of the temperature give the linear answer to the noise alone;
    what is left of a displacement without it has the mean ``kT ∇·M`` and little scatter.
    """
    cold = 1e-8
    moves = displacements(system, x, temperature, n, seed) / SHORT
    cold_moves = displacements(system, x, cold * temperature, n, seed) / SHORT
    still = displacements(system, x, 1e-30 * temperature, 1, seed)[0] / SHORT
    linear = (cold_moves - still) / cold**0.5
    return still, linear, moves - still - linear


@each_place
def test_displacements_over_a_step_have_the_covariance_of_the_mobility(place):
    """Fluctuation–dissipation: the covariance over a short step is 2 kT M Δt, with M of the reference.

    6000 draws: every entry within 5 of its standard errors ``√((M_ii M_jj + M_ij²)/n)`` (1.8 % on the
    diagonal), and the mean square in the metric of M within 4 of its own, ``√(2/(n N d))``, 0.5 %.
    """
    n, temperature = 6000, 0.7
    system, x = bent_chain_in(place)
    moves = displacements(system, x, temperature, n, seed=11)
    moves = moves / np.sqrt(2 * temperature * SHORT)
    m = mobility(place, system, x)
    moves -= moves.mean(0)
    covariance = moves.T @ moves / (n - 1)
    error = np.sqrt((np.outer(np.diag(m), np.diag(m)) + m * m) / n)
    assert np.abs((covariance - m) / error).max() < 5
    white = np.linalg.solve(np.linalg.cholesky(m), moves.T)
    assert abs((white**2).mean() - 1) < 4 * np.sqrt(2 / white.size)


@each_place
def test_mean_displacement_is_force_and_drift(place):
    """``M F + kT ∇·M`` with M and F of the reference and ∇·M by numerical differentiation.

    The deterministic part to 1e-3 of the largest velocity (ℰ Δt = 2e-4); the noise's linear part has
    zero mean within 5 standard errors; what is left is the drift within 5, from 2500 draws, and where
    the drift is not zero it is more than 10 of them away from zero.
    """
    temperature = 0.7
    system, x = bent_chain_in(place)
    still, linear, left = drift_parts(system, x, temperature, 2500, seed=12)
    force = -reference.gradient(lambda p: reference.total_energy(p, MODULUS), x)
    velocity = mobility(place, system, x) @ force.ravel()
    assert np.abs(still - velocity).max() < 1e-3 * np.abs(velocity).max()
    assert deviation(sample_average(linear), 0.0) < 5
    drift = temperature * divergence(lambda p: mobility(place, system, p), x)
    assert deviation(sample_average(left), drift) < 5
    if place == "volume":
        assert np.abs(drift).max() < 1e-8
    else:
        assert deviation(sample_average(left), 0.0) > 10


def test_a_bead_near_a_wall_drifts_away_from_it():
    """``kT dM/dh`` along the normal with ``M = 1 − 9/(8h) + 1/(2h³) − 1/(8h⁵)`` (Swan & Brady 2007), 0 along the wall.

    At h = 1.3, where dM/dh is 0.270: 3000 draws, standard error 2.6 %, tolerance 4 of them.
    """
    h, temperature = 1.3, 0.7
    wall = {"point": (0.0, -60.0, 0.0)}
    system = assemble(chain_scene(1, space="volume", wall=wall, temperature=temperature))
    *_, left = drift_parts(system, np.array([[0.3, h - 60.0, -0.2]]), temperature, 3000, seed=13)
    mean, error = sample_average(left)
    expected = temperature * (9 / (8 * h**2) - 3 / (2 * h**4) + 5 / (8 * h**6))
    assert error[1] < 0.035 * expected
    assert abs(mean[1] - expected) < 4 * error[1]
    assert np.abs(mean[[0, 2]] / error[[0, 2]]).max() < 4


@pytest.mark.parametrize("form", ["RPY", "RPY-overlap"])
def test_the_mobility_of_unbounded_fluid_has_no_divergence(form):
    """∇·M = 0 in volume for both forms, to the 1e-9 of the differences: the fluid is incompressible.

    In the plane the motion across it is missing from the sum, and bead i drifts by ``Σ_j g(r) r̂_ij``
    with ``g = 3/(4r²) − 3/(2r⁴)``, overlapping ``g = 3/32``, by hand from the two forms.
    """
    x = bent_chain(6, 7, 3, bend=0.8, stretch=0.2)
    assert np.abs(divergence(PairMobility(form, 3).matrix, x)).max() < 1e-9
    x = bent_chain(6, 7, 2, bend=0.8, stretch=0.2)
    apart = x[:, None] - x[None]
    r = np.linalg.norm(apart, axis=2) + np.eye(len(x))
    g = 3 / (4 * r**2) - 3 / (2 * r**4)
    if form == "RPY-overlap":
        assert (r < 2).sum() > len(x)  # some beads do overlap
        g = np.where(r < 2, 3 / 32, g)
    expected = (g[..., None] * apart / r[..., None]).sum(1).ravel()
    assert np.abs(divergence(PairMobility(form, 2).matrix, x) - expected).max() < 1e-9
    assert np.abs(expected).max() > 0.01


# --- long runs: diffusion and equilibrium ---


@each_space
def test_a_free_bead_diffuses(space):
    """``⟨Δx²⟩ = 2 d kT t`` (Einstein) and Gaussian: ⟨Δx⁴⟩ = 3 ⟨Δx²⟩².

    Over t = 1, 10 and 50 in a run of 5000, disjoint intervals: relative standard errors of n d
    normal numbers, ``√(2/nd)`` from 1.2 % to 10 %, and ``√(96/nd)``; tolerance 4 of them.
    """
    temperature, dim = 0.5, DIMS[space]
    scene = chain_scene(1, space=space, hydrodynamics="none", noise={"peclet": 1 / temperature, "step": 0.5})
    run = simulate(scene, Numerics(interval=0.5), t_end=5000.0)
    assert len(run.t) == 10001
    for t in (1, 10, 50):
        moves = np.diff(run.positions[:: 2 * t, 0, :dim], axis=0).ravel() / np.sqrt(2 * temperature * t)
        assert abs((moves**2).mean() - 1) < 4 * np.sqrt(2 / moves.size)
        assert abs((moves**4).mean() - 3) < 4 * np.sqrt(96 / moves.size)


def test_heights_above_a_wall_are_boltzmanns():
    """Heavy beads above a wall with contact: heights have the density ``exp(−U/kT)``, by quadrature.

    ``U = G h + S (H² − h²)⁵/(10 (H² − 1)⁴)``, the integral of weight and contact force.  Fifteen beads
    1000 a apart do as fifteen runs of one, and start at their quantiles.  Mean height is within 4 standard
    errors, of about 0.005 a, and the occupation of four equally probable layers within 5, of about 2 %
    of a layer; the step's own error, first order, is about one of them.  Without the drift the density
    would be ``exp(−U/kT)/M_zz``: the mean is more than 6 errors away from that one's.
    """
    n, weight, strength, top = 15, 4.0, 20.0, 2.0
    h = np.linspace(0.8, 15.0, 20001)  # below it is 1e-5 of the whole
    barrier = np.clip(top**2 - h**2, 0, None) ** 5 / (10 * (top**2 - 1) ** 4)
    density = np.exp(-weight * h - strength * barrier)
    without_drift = density / (1 - 9 / (8 * h) + 1 / (2 * h**3) - 1 / (8 * h**5))
    expected, wrong = ((h * p).sum() / p.sum() for p in (density, without_drift))
    share = np.cumsum(density) / density.sum()

    wall = {"point": (0.0, -60.0, 0.0)}
    contact = {"strength": strength, "reach": 2 * top}
    parts = {"stretching": None, "bending": None, "gravity": {"strength": weight}}
    system = assemble(chain_scene(n, space="volume", wall=wall, contact=contact, **parts))
    start = np.zeros((n, 3))
    start[:, 0] = 1000.0 * np.arange(n)
    start[:, 1] = np.interp((np.random.default_rng(1).permutation(n) + 0.5) / n, share, h) - 60.0
    integrator = integrator_of(system, 1.0, 0.01, seed=21)
    states = np.array(list(islice(integrator.states(system.to_state(start), 0.05), 2800)))
    heights = system.to_positions(states)[..., 1] + 60.0
    mean, error = block_average(heights.mean(1), 40)
    assert abs(mean - expected) < 4 * error
    assert abs(mean - wrong) > 6 * error
    layer = np.searchsorted(np.interp([0.25, 0.5, 0.75], share, h), heights)
    occupied = np.stack([(layer == k).mean(1) for k in range(4)], axis=1)
    assert deviation(block_average(occupied, 40), 0.25) < 5


def bond_energy(dim, modulus):
    """⟨ℰ (r/2 − 1)²⟩ of one bond at kT = 1, weights ``r^(d−1) exp(−U)``: about 1/2."""

    def integral(observed):
        scatter = (2 / modulus) ** 0.5
        low, high = max(0.0, 2 - 12 * scatter), 2 + 12 * scatter
        weight = lambda r: r ** (dim - 1) * np.exp(-modulus * (r / 2 - 1) ** 2) * observed(r)  # noqa: E731
        return quad(weight, low, high, points=[2.0])[0]

    return integral(lambda r: modulus * (r / 2 - 1) ** 2) / integral(lambda r: 1.0)


def mean_cosine(dim, stiffness):
    """⟨cos θ⟩ with the weight ``exp(κ cos θ)`` of a planar angle, and ``sin θ`` times that in volume."""
    return i1e(stiffness) / i0e(stiffness) if dim == 2 else 1 / np.tanh(stiffness) - 1 / stiffness


def measure_fibers(space, hydrodynamics, step, t_end, seed):
    """Ten free fibers of three beads at kT = 1: history of the mean cos θ and of the mean energy of a bond.

    They start 2.5 a apart, so that they overlap and push each other through the fluid; that does
    not change the equilibrium, in which bonds and angles are independent of each other.
    """
    places = [{"place": (0.0, 2.5 * k, 0.0)} for k in range(10)]
    scene = chain_scene(3, space=space, hydrodynamics=hydrodynamics, fibers=places)
    system = assemble(scene)
    integrator = integrator_of(system, 1.0, step, seed)
    interval, settled = step * max(1, round(0.08 / step)), 3.0
    states = integrator.states(system.to_state(scene.start()), interval)
    states = np.array(list(islice(states, round(settled / interval), round((settled + t_end) / interval))))
    bonds = np.diff(system.to_positions(states).reshape(len(states), 10, 3, 3), axis=2)
    r = np.linalg.norm(bonds, axis=3)
    cosine = (bonds[:, :, 0] * bonds[:, :, 1]).sum(-1) / (r[..., 0] * r[..., 1])
    return cosine.mean(1), (MODULUS * (r / 2 - 1) ** 2).mean((1, 2))


@pytest.mark.parametrize("hydrodynamics", ["none", "RPY-overlap"])
@each_space
def test_bonds_and_angles_have_their_thermal_energy(space, hydrodynamics):
    """Equipartition of a phantom chain at κ = ℰ/(8kT) = 3, which hydrodynamics does not change.

    ⟨cos θ⟩, and with it the bending energy κ (1 − ⟨cos θ⟩), is I₁(κ)/I₀(κ) in the plane and coth κ − 1/κ
    in volume; the energy of a bond is that of its quadrature.  Both within 4 standard errors, at most
    8 % and 3 % of these energies; the step's own error, first order, is at most 2 % of the bond's.
    """
    dim, seed = DIMS[space], 31
    angles, bonds = measure_fibers(space, hydrodynamics, 0.01, 100.0, seed)
    cosine, error = block_average(angles, 16)
    assert error < 0.08 * (1 - cosine)
    assert abs(cosine - mean_cosine(dim, MODULUS / 8)) < 4 * error
    energy, error = block_average(bonds, 16)
    assert error < 0.03 * energy
    assert abs(energy - bond_energy(dim, MODULUS)) < 4 * error


def test_error_of_a_mean_falls_with_the_step():
    """Weak order one: the error of the mean bond energy at steps 0.12, 0.06, 0.03 is a power of the step near one.

    Longer runs gave 0.142 ± 0.003, 0.058 ± 0.002 and 0.028 ± 0.002.  With 0.005 here the slope of the
    logarithms is known to ± 0.14, and between 0.7 and 1.8, four times that about their 1.2.
    """
    steps = (0.12, 0.06, 0.03)
    errors = []
    for step in steps:
        energy, error = block_average(measure_fibers("volume", "RPY-overlap", step, 250.0, seed=41)[1])
        errors.append(energy - bond_energy(3, MODULUS))
        assert error < 0.008
    assert 0.7 < np.polyfit(np.log(steps), np.log(errors), 1)[0] < 1.8


@each_space
def test_a_stiff_fiber_keeps_its_energy_at_large_steps(space):
    """At ℰ Δt = 20, twenty times an explicit scheme's limit: kT/2 for each of 4 bonds and of 3 (d − 1) bends.

    ℰ/kT = 1e6, so that the linear theory of the implicit midpoint holds; within 4 standard errors of
    at most 5 % of the exact averages.
    """
    modulus, dim = 1e6, DIMS[space]
    scene = chain_scene(5, modulus, space=space)
    system = assemble(scene)
    integrator = integrator_of(system, 1.0, 20.0 / modulus, seed=51)
    states = np.array(list(islice(integrator.states(system.to_state(scene.start()), 20.0 / modulus), 500, 8500)))
    x = system.to_positions(states)
    stretching, bending = reference.stretching_energy(x, modulus), reference.bending_energy(x, modulus)
    stiffness = modulus / 8
    for measured, exact in (
        (stretching, 4 * bond_energy(dim, modulus)),
        (bending, 3 * stiffness * (1 - mean_cosine(dim, stiffness))),
    ):
        mean, error = block_average(measured)
        assert error < 0.05 * exact
        assert abs(mean - exact) < 4 * error


class LinearMotion:
    """``ẋ = −M K x`` with constant symmetric matrices: what the integrator asks of a system, and of its mobility."""

    placed = False

    def __init__(self, mobility, stiffness):
        self.m, self.k = mobility, stiffness
        self.mobility = self
        self.shape = (len(mobility), 1)

    def matrix(self, x):
        return self.m

    def velocity(self, x, force=None, u=None):
        """The system's velocity, or the mobility's into ``u``."""
        if force is None:
            return -self.m @ self.k @ x
        u[:] = self.m @ force

    def velocity_jacobian(self, x):
        return -self.m @ self.k

    def to_state(self, x):
        return x.ravel().copy()

    def to_positions(self, y):
        return y.reshape(*y.shape[:-1], *self.shape)


def test_linear_springs_have_their_equilibrium_at_any_step():
    """Three coupled coordinates with rates 10/Δt, 1/Δt and 0.1/Δt: the covariance is kT K⁻¹ (equipartition).

    All entries within 5 standard errors of block averages, about 4 % on the diagonal.  Along the stiff
    mode an implicit Euler step would keep 2/(2 + 10) of the energy, which is more than 20 errors away.
    """
    temperature, step, rates = 0.3, 0.5, np.array([10.0, 1.0, 0.1])
    rng = np.random.default_rng(3)
    root = rng.normal(size=(3, 3)) + 2 * np.eye(3)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    inverse = np.linalg.inv(root)
    system = LinearMotion(root @ root.T, inverse.T @ turn @ np.diag(rates / step) @ turn.T @ inverse)
    assert np.allclose(np.sort(np.linalg.eigvals(system.m @ system.k).real), np.sort(rates / step))
    states = np.array(list(islice(integrator_of(system, temperature, step, 61).states(np.zeros(3), step), 200, 12200)))
    covariance = block_average(states[:, :, None] * states[:, None, :])
    assert deviation(covariance, temperature * np.linalg.inv(system.k)) < 5
    stiff = (states @ inverse.T @ turn)[:, 0]  # the mode's energy is its rate times its square over two
    energy, error = block_average(rates[0] / step * stiff**2 / 2)
    assert error < 0.03 * temperature / 2
    assert abs(energy - temperature / 2) < 4 * error
    assert abs(energy - temperature / 2 * 2 / (2 + rates[0])) > 20 * error


# --- bookkeeping and refusals ---

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
