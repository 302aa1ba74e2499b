"""Effects alone and all at once: Jacobians, energies and invariants of the systems that scenes make.

A scene is a row of ``ALONE`` or ``TOGETHER``; what must not change its motion is read off its parts.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from problems import crumpled_chain, random_rotation, taylor_slope
from sedfiber.scene.assembly import assemble
from sedfiber.scene.scene import Scene

N, CENTRE = 7, 3
BASE = {"B": 24.0 * N**3 / 30.0, "theta0": 0.5, "n_beads": N, "hydrodynamics": "RPY-overlap"}  # ℰ = 30
NOTHING = dict.fromkeys(("gravity", "stretching", "bending"), "none")
WALL = {"point": [0.5, -12.0, 1.0], "normal": [0.0, 0.8, 0.6]}
IN_PLANE = {"gradient": [[0.2, 0.5], [-0.3, -0.2]]}
GENERAL = {"gradient": [[0.2, -0.5, 0.7], [1.1, 0.3, -0.4], [0.6, 0.9, -0.5]]}
FLOOR = WALL | {"point": [0.5, -3.0, 4.0]}  # through the origin, where a linear flow rests
ALONG_FLOOR = {"gradient": [[0.0, 0.8, 0.6], [0.0, 0.192, 0.144], [0.0, -0.256, -0.192]]}  # (1, 0.24, −0.32) of height
CONTACT = {"strength": 20.0, "reach": 3.0}
OWN_EFFECTS = """
import numpy as np

class Well:
    def force(self, x):
        return -0.01 * (x * x).sum(axis=1, keepdims=True) * x

    def energy(self, x):
        return 0.0025 * ((x * x).sum(axis=1) ** 2).sum()

class Swirl:  # no energy: it turns
    def force(self, x):
        return 0.3 * np.column_stack([np.sin(x[:, 1]), np.cos(x[:, 0]), 0.2 * x[:, 0] * x[:, 1]])[:, : x.shape[1]]

class Cells:
    def velocity(self, x):
        return 0.2 * np.column_stack([np.sin(x[:, 1]), np.sin(x[:, 0]), np.cos(x[:, 0])])[:, : x.shape[1]]
"""
FLOWS = {name: {"name": name, "rate": 0.3} for name in ("shear", "extension", "rotation")}
FLOWS["parabolic"] = {"name": "parabolic", "peak": 2.0, "half_width": 9.0}
TWO = [{}, {"B": 2 * BASE["B"], "place": [0.0, 30.0]}]
LIKE = [{}, {"place": [0.0, 30.0]}]

ALONE = {
    "gravity": {"gravity": {}},
    "oblique gravity": {"gravity": {"direction": [0.6, -0.8], "strength": 2.0}},
    "stretching": {"stretching": {"factor": 0.7}},
    "bending": {"bending": {}},
    "curved bending": {"bending": {"curvature": 0.2}, "shape": "rest"},
    "contact": {"contact": CONTACT},
    "fibers": {"fibers": TWO, "stretching": {}, "bending": {}},
    **{name: {"flow": flow} for name, flow in FLOWS.items()},
    **{f"free {name}": {"flow": flow | {"couple": False}} for name, flow in FLOWS.items()},
    "gradient": {"flow": IN_PLANE},
    **{name: {"own": [{"file": "own.py", "effect": name}]} for name in ("Well", "Swirl", "Cells")},
}
SPATIAL = {
    "gradient": {"flow": GENERAL},
    "wall": {"wall": WALL, "gravity": {}},
    "wall and contact": {"wall": WALL, "contact": CONTACT | {"reach": 4.0}},
}
ELASTIC = {"stretching": {"factor": 0.7}, "bending": {}, "gravity": {}}
ALL = ELASTIC | {"contact": CONTACT, "gravity": {"direction": [0.6, -0.8], "strength": 2.0}, "fibers": TWO}
ALL |= {"own": [{"file": "own.py", "effect": name} for name in ("Well", "Swirl", "Cells")]}
TOGETHER = {
    "study": ELASTIC,
    "two alike": ELASTIC | {"contact": CONTACT, "fibers": LIKE},
    "sheared": ELASTIC | {"contact": CONTACT, "flow": FLOWS["shear"]},
    "stretched": ELASTIC | {"contact": CONTACT, "flow": FLOWS["extension"]},
    "channel": ELASTIC | {"contact": CONTACT, "flow": FLOWS["parabolic"]},
    "all": ALL | {"bending": {"curvature": 0.2}, "shape": "rest", "flow": IN_PLANE},
    "all in a channel": ALL | {"flow": FLOWS["parabolic"]},
}
SCENES = {f"{name}, {space}": values | {"space": space} for space in ("plane", "volume")
          for name, values in (ALONE | TOGETHER | (SPATIAL if space == "volume" else {})).items()}  # fmt: skip
SCENES["floor"] = TOGETHER["two alike"] | {"wall": WALL, "space": "volume"}
SCENES["all at a wall"] = TOGETHER["all"] | {"wall": FLOOR, "space": "volume", "flow": ALONG_FLOOR}
SCENES["all at a wall"] |= {"fibers": [fiber | {"place": [0.0, 30.0 * (k + 1)]} for k, fiber in enumerate(TWO)]}
for _form in ("none", "RPY"):
    for _name in ("all, plane", "all in a channel, volume"):
        SCENES[f"{_name}, {_form}"] = SCENES[_name] | {"hydrodynamics": _form}
SCENES["all, plane, Oseen"] = SCENES["all, plane"] | {"hydrodynamics": "Oseen"}
SCENES["all at a wall, RPY"] = SCENES["all at a wall"] | {"hydrodynamics": "RPY"}


@pytest.fixture(scope="module")
def systems(tmp_path_factory):
    """The System of each scene by name, made once."""
    path = tmp_path_factory.mktemp("own") / "own.py"
    path.write_text(OWN_EFFECTS)
    made = {}

    def system(name):
        if name not in made:
            values = BASE | NOTHING | SCENES[name]
            own = [one | {"file": str(path)} for one in values.get("own", ())]
            made[name] = assemble(Scene(**(values | {"own": own})))
        return made[name]

    return system


def positions(name, seed, closest=1.2):
    """Crumpled fibers in each other's reach off the origin, (beads, d); with a wall the lowest bead at height 1.5."""
    values, dim = SCENES[name], 2 if SCENES[name]["space"] == "plane" else 3
    fibers = [crumpled_chain(seed + k, N, dim, closest) for k in range(len(values.get("fibers", [0])))]
    for one in fibers[1:]:
        one += (fibers[0].max(axis=0) - one.min(axis=0)) * np.eye(dim)[1] + 1.5 * np.eye(dim)[1]
    x = np.vstack(fibers) + np.array([1.7, -0.6, 1.1])[:dim]
    wall = values.get("wall")
    return x if wall is None else x + (1.5 - heights(x, wall).min()) * np.array(wall["normal"])


def heights(x, wall):
    """Heights (beads,) above the wall."""
    return (x - np.array(wall["point"])) @ np.array(wall["normal"])


def scale(system, x):
    """What round-off is measured against: the largest force times the largest mobility, one at least."""
    return 1.0 + np.abs(system.force(x)).sum()


def where(holds):
    """Parametrize a test by the scenes for which ``holds(values)``."""
    return pytest.mark.parametrize("name", [name for name, values in SCENES.items() if holds(values)])


@where(lambda values: True)
def test_a_state_moves_as_its_positions_do(systems, name):
    """Rates of the state at any place are ``M F + u∞`` of the laboratory positions, and the work's is ``F·ẋ``."""
    system, x = systems(name), positions(name, 7)
    rows = system.rhs(0.0, system.to_state(x))
    u = rows[:-1].reshape(x.shape) + rows[:-1].reshape(x.shape)[system.centre]
    u[system.centre] = rows[:-1].reshape(x.shape)[system.centre]
    force, nonconservative = system.force(x), np.zeros_like(x)
    for part in system.nonconservative:
        part.add_force(x, nonconservative)
    carried = np.zeros_like(x)
    for flow in system.flows:
        flow.add_velocity(x, carried)
    expected = (system.mobility.matrix(x) @ force.ravel()).reshape(x.shape) + carried
    assert_allclose(u, expected, rtol=0, atol=1e-12 * scale(system, x))
    power = ((force - nonconservative) * expected).sum()
    assert rows[-1] == pytest.approx(power, rel=1e-11, abs=1e-10 * scale(system, x))


@where(lambda values: True)
@pytest.mark.parametrize("seed", range(2))
def test_jacobian_taylor(systems, name, seed):
    """The error of ``f(y + εv) ≈ f(y) + ε J v`` falls as ε², centre and work included; zero if f is linear."""
    system, x = systems(name), positions(name, seed)
    y, rng = system.to_state(x), np.random.default_rng(seed)
    y[-1], direction = 3.0, rng.normal(size=y.size)
    jac, eps = system.jacobian(0.0, y), np.array([1e-4, 5e-5, 2e-5, 1e-5])

    def f(y):
        return system.rhs(0.0, y)

    off = np.linalg.norm(f(y + eps[0] * direction) - f(y) - eps[0] * jac @ direction)
    if off > 1e-11 * scale(system, x):
        assert taylor_slope(f, jac, y, direction, eps) == pytest.approx(2, abs=0.1)


@where(lambda values: True)
def test_jacobian_entry_by_entry(systems, name):
    """Each column against a central difference of the right-hand side; the work is no argument of it."""
    system, x, h = systems(name), positions(name, 5), 1e-6
    y = system.to_state(x)
    columns = [(system.rhs(0.0, y + h * e) - system.rhs(0.0, y - h * e)) / (2 * h) for e in np.eye(y.size)]
    jac = system.jacobian(0.0, y)
    assert_allclose(jac, np.array(columns).T, rtol=0, atol=1e-7 * max(scale(system, x), np.abs(jac).max()))
    assert not jac[:, -1].any()


@where(lambda values: True)
def test_conservative_force_is_minus_the_energys_gradient(systems, name):
    """Sum of all conservative parts against central differences of ``System.energy``, 1e-6 of the largest force."""
    system, x, h = systems(name), positions(name, 3), 1e-5
    force = np.zeros_like(x)
    for part in system.forces:
        part.add_force(x, force)
    shifts = h * np.eye(x.size).reshape(x.size, *x.shape)
    slopes = [(system.energy(x - shift) - system.energy(x + shift)) / (2 * h) for shift in shifts]
    assert_allclose(np.reshape(slopes, x.shape), force, rtol=0, atol=1e-6 * (1.0 + np.abs(force).max()))


@where(lambda values: not {"wall", "flow", "own"} & set(values))
@given(seed=st.integers(0, 10**6))
def test_moved_beads_move_alike(systems, name, seed):
    """Without wall, flow and effects of one's own no place is special: not a bit of the state's rate changes."""
    system, rng = systems(name), np.random.default_rng(seed)
    y = system.to_state(positions(name, seed))
    moved = y.copy()
    moved[:-1].reshape(system.shape)[system.centre] += rng.uniform(-1e5, 1e5, system.shape[1])
    assert np.array_equal(system.rhs(0.0, moved), system.rhs(0.0, y))


def free_of_directions(values):
    """Nothing but gravity, straight down or not at all, tells one direction in volume from another."""
    return not {"wall", "flow", "own"} & set(values) and "direction" not in values.get("gravity", {})


@where(lambda values: free_of_directions(values) and values["space"] == "volume")
@given(seed=st.integers(0, 10**6), angle=st.floats(-np.pi, np.pi))
def test_turned_about_gravity_they_move_turned(systems, name, seed, angle):
    """In volume; about any axis where there is no gravity."""
    system, x, c, s = systems(name), positions(name, seed), np.cos(angle), np.sin(angle)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) if "gravity" in SCENES[name] else random_rotation(seed, 3)
    tolerance = 1e-12 * scale(system, x)
    assert_allclose(system.velocity(x @ turn.T), system.velocity(x) @ turn.T, rtol=0, atol=tolerance)


def symmetric(values):
    """Left and right are alike: no sideways gravity, no turning flow, no signed curvature, no effect of one's own."""
    turning = values.get("flow", FLOWS["extension"]).get("name") != "extension"
    return not ("own" in values or turning or "direction" in values.get("gravity", {}) or signed(values))


def signed(values):
    """A planar fiber that is curved at rest knows left from right, and its first bead from its last."""
    return values["space"] == "plane" and "curvature" in values.get("bending", {})


@where(symmetric)
@given(seed=st.integers(0, 10**6))
def test_mirror_image_moves_as_the_mirror_image(systems, name, seed):
    """x → −x, with extension and along a wall whose normal has no x as well."""
    system, x = systems(name), positions(name, seed)
    mirror = np.array([-1.0, 1.0, 1.0])[: system.shape[1]]
    x = x if "wall" not in SCENES[name] else x - [WALL["point"][0], 0, 0]
    u, tolerance = system.velocity(x), 1e-12 * scale(system, x)
    assert_allclose(system.velocity(mirror * x), mirror * u, rtol=0, atol=tolerance)


@where(lambda values: not any("B" in fiber for fiber in values.get("fibers", ())) and not signed(values))
@given(seed=st.integers(0, 10**6))
def test_reversed_bead_order_moves_in_reversed_order(systems, name, seed):
    """Nothing tells the first bead of the first fiber from the last of the last one like it."""
    system, x = systems(name), positions(name, seed)
    u, tolerance = system.velocity(x), 1e-12 * scale(system, x)
    assert_allclose(system.velocity(x[::-1].copy())[::-1], u, rtol=0, atol=tolerance)


@where(lambda values: not {"wall", "flow", "own", "gravity"} & set(values))
@given(seed=st.integers(0, 10**6))
def test_internal_forces_and_torques_sum_to_zero(systems, name, seed):
    """Springs, bends and contact cannot push or turn the beads as a whole."""
    system, x = systems(name), positions(name, seed)
    force, tolerance = system.force(x), 1e-12 * scale(system, x)
    x = np.column_stack([x, np.zeros(len(x))])[:, :3]
    force = np.column_stack([force, np.zeros(len(x))])[:, :3]
    assert_allclose(force.sum(axis=0), 0, atol=tolerance)
    assert_allclose(np.cross(x, force).sum(axis=0), 0, atol=30 * tolerance)


@pytest.mark.parametrize("name", ["two alike, plane", "two alike, volume", "all at a wall", "floor"])
@given(seed=st.integers(0, 10**6), closest=st.floats(0.1, 1.2), lowest=st.floats(1.0, 30.0))
def test_mobility_is_symmetric_and_positive_definite(systems, name, seed, closest, lowest):
    """The overlap form however beads overlap, and with a wall down to its touch."""
    x = positions(name, seed, closest)
    if "wall" in SCENES[name]:
        wall = SCENES[name]["wall"]
        x += (lowest - heights(x, wall).min()) * np.array(wall["normal"])
    m = systems(name).mobility.matrix(x)
    assert_allclose(m, m.T, rtol=0, atol=1e-14)
    assert np.linalg.eigvalsh(m)[0] > 0


@where(lambda values: "contact" in values)
@pytest.mark.parametrize("seed", [0, 1, 3, 5])
def test_beads_touch_where_there_is_contact(systems, name, seed):
    """The positions above hold pairs in reach, so contact was at work in what was compared."""
    system, x = systems(name), positions(name, seed)
    assert sum(part.energy(x) for part in system.forces if type(part).__name__ == "Contact") > 0


@where(lambda values: "wall" in values and not {"flow", "own"} & set(values))
@given(seed=st.integers(0, 10**6), far=st.floats(-100, 100), out=st.floats(-100, 100))
def test_along_a_wall_every_place_is_alike(systems, name, seed, far, out):
    """Moved parallel to the wall the beads move alike."""
    system, x = systems(name), positions(name, seed)
    along = np.array([far, 0.6 * out, -0.8 * out])
    assert_allclose(system.velocity(x + along), system.velocity(x), rtol=0, atol=1e-11 * scale(system, x))


@where(lambda values: "flow" in values and not {"wall", "own"} & set(values))
@given(seed=st.integers(0, 10**6), far=st.floats(-100, 100))
def test_moved_in_a_flow_velocities_shift_by_the_flows(systems, name, seed, far):
    """By ``G·shift`` in a linear flow, with its couples too; by nothing along x in the parabolic one."""
    system, x, flow = systems(name), positions(name, seed), SCENES[name]["flow"]
    d = system.shape[1]
    shift = far * (np.eye(d)[0] if flow.get("name") == "parabolic" else np.random.default_rng(seed).normal(size=d))
    rows = {"shear": [[0, 1], [0, 0]], "extension": [[1, 0], [0, -1]], "rotation": [[0, -1], [1, 0]]}
    g = np.zeros((3, 3))
    if "gradient" in flow:
        g[: len(flow["gradient"]), : len(flow["gradient"])] = flow["gradient"]
    elif flow["name"] in rows:
        g[:2, :2] = flow["rate"] * np.array(rows[flow["name"]])
    tolerance = 1e-11 * (scale(system, x) + np.abs(shift).sum())
    assert_allclose(system.velocity(x + shift), system.velocity(x) + g[:d, :d] @ shift, rtol=0, atol=tolerance)
