"""The audit: each left-out effect is weighed by a number that can be worked out by hand, in fixed words."""

import re

import numpy as np
import pytest

import reference
from problems import straight_chain
from sedfiber import Numerics, Scene, simulate, steady_state
from sedfiber.scene.assembly import assemble
from sedfiber.simulation.audit import audit
from sedfiber.simulation.equilibria.transverse import leading_rate, transverse_matrix
from sedfiber.simulation.recorded_run import Run

WORDS = re.compile(
    r"^(?P<effect>[a-z ]+): left out, and it (?:does not matter \((?P<no>.+)\)|matters \((?P<yes>.+)\): add .+)$"
)


def verdicts(scene, *shapes):
    """What the audit says of a made-up run through the given shapes (N, d), a time unit apart."""
    system = assemble(scene)
    states = np.array([system.to_state(x) for x in shapes])
    return {v.effect: v for v in audit(scene, Run.of(system, np.arange(float(len(shapes))), states))}


def scene(**parts):
    """Five beads in the plane."""
    return Scene(**({"B": 1000, "theta0": 0.5, "n_beads": 5} | parts))


def test_every_verdict_is_one_line_in_the_fixed_words():
    """ "left out, and it does not matter (number)" or "left out, and it matters (number): add …"."""
    hairpin = straight_chain(5, 2)
    hairpin[3:] = [[2.0, 1.5], [0.2, 1.5]]
    for shape in (straight_chain(5, 2), hairpin):
        for verdict in verdicts(scene(depth=10.0), shape).values():
            match = WORDS.match(verdict.words)
            assert match and "\n" not in verdict.words
            assert match["effect"] == verdict.effect
            assert bool(match["yes"]) == verdict.matters
            assert f"{verdict.number:.3g} " in verdict.words
            assert verdict.to_dict()["words"] == verdict.words


def test_the_overlap_form_is_weighed_by_the_mobility_of_the_closest_pair():
    """Two beads 1.7a apart: the largest relative change of the pair's two mobilities, from the NumPy reference."""
    bent = straight_chain(5, 2)
    bent[4] = bent[2] + [0.0, 1.7]
    pair = np.array([[0.0, 0.0], [1.7, 0.0]])
    plain, overlap = (reference.rpy(pair, form)[[2, 3], [0, 1]] for form in (False, True))
    verdict = verdicts(scene(), straight_chain(5, 2), bent)["overlap form"]
    assert verdict.number == pytest.approx(np.abs(plain / overlap - 1).max(), rel=1e-12)
    assert verdict.matters and "hydrodynamics: RPY-overlap" in verdict.words
    assert not verdicts(scene(), straight_chain(5, 2))["overlap form"].matters
    assert "overlap form" not in verdicts(scene(hydrodynamics="RPY-overlap"), bent)


def test_contact_is_weighed_by_the_smallest_gap():
    """Beads 0 and 4, 1.6a apart, overlap by 0.4a; with contact in the scene nothing is said."""
    hairpin = straight_chain(5, 2)
    hairpin[4] = hairpin[0] + [0.0, 1.6]
    verdict = verdicts(scene(), hairpin)["contact"]
    assert verdict.matters and verdict.number == pytest.approx(-0.4)
    assert "contact" not in verdicts(scene(contact={}), hairpin)


def test_the_bottom_is_weighed_by_the_stated_depth():
    """Ten radii fallen of a depth of 8, or of 40; without a depth, or with a wall, nothing is said."""
    start = straight_chain(5, 2)
    fallen = start - [0.0, 10.0]
    assert verdicts(scene(depth=8.0), start, fallen)["wall"].number == pytest.approx(1.25)
    assert verdicts(scene(depth=8.0), start, fallen)["wall"].matters
    assert not verdicts(scene(depth=40.0), start, fallen)["wall"].matters
    assert "wall" not in verdicts(scene(), start, fallen)


def test_the_walls_of_a_channel_are_weighed_by_the_half_width():
    """A bead 15 a from the middle of a parabolic flow of half-width 20 or 10; of other flows nothing is said."""
    start, flow = straight_chain(5, 2), {"name": "parabolic", "peak": 1.0}
    for half_width, matters in ((20.0, False), (10.0, True)):
        parts = {"flow": flow | {"half_width": half_width}}
        verdict = verdicts(scene(**parts), start, start - [0.0, 15.0])["channel walls"]
        assert verdict.matters is matters and verdict.number == pytest.approx(15.0 / half_width)
    assert "channel walls" not in verdicts(scene(flow={"name": "shear", "rate": 0.1}), start)


def test_inextensibility_is_weighed_by_the_largest_strain():
    """One bond of 2.2a: a strain of 0.1, above the 0.05 from which it matters."""
    stretched = straight_chain(5, 2)
    stretched[4, 0] += 0.2
    verdict = verdicts(scene(), stretched)["inextensibility"]
    assert verdict.matters and verdict.number == pytest.approx(0.1)
    assert not verdicts(scene(), straight_chain(5, 2))["inextensibility"].matters
    assert verdict.remedy.startswith("stretching: {factor: 10}, ")
    stiffer = verdicts(scene(stretching={"factor": 10}), stretched)["inextensibility"]
    assert stiffer.remedy.startswith("stretching: {factor: 100}, ")  # never what is there already


@pytest.mark.parametrize("factor", [10, 1e4])
def test_the_studys_scene_settles_with_the_stiffer_springs_that_are_advised(factor):
    """Without an end: the terminal shape is found, and its largest strain is that of the study over the factor."""
    strains = []
    for one in (1, factor):
        run = simulate(Scene(1000, 0.5, stretching={"factor": one}))
        assert run.settling_time == pytest.approx(136.1, abs=0.3)
        strains.append(run.metadata["checks"]["bond_strain_max"])
    assert strains[0] / strains[1] == pytest.approx(factor, rel=0.01)


@pytest.mark.parametrize(("B", "matters"), [(1000, False), (10000, True)])
def test_the_third_dimension_matters_at_high_B(B, matters):
    """The planar fall at ℬ = 1000 is stable out of the plane, at 10000 it is not; the rate is the terminal shape's."""
    run = simulate(Scene(B, np.pi / 4))
    verdict = next(v for v in run.metadata["audit"] if v["effect"] == "third dimension")
    state = steady_state(B)
    spatial = assemble(Scene(B, 0.5, space="volume"))
    rate = leading_rate(transverse_matrix(spatial, state.positions), state.positions)
    assert verdict["matters"] is matters
    assert verdict["number"] == pytest.approx(rate, rel=1e-2)


def test_transverse_matrix_is_the_derivative_of_the_reference():
    """ż = A z: central differences of NumPy's velocities out of the plane, relative to the centre bead, give A."""
    state, h = steady_state(2000), 1e-4
    modulus = Scene(2000, 0.0).modulus
    matrix = transverse_matrix(assemble(Scene(2000, 0.5, space="volume")), state.positions)
    for column, bead in enumerate(np.delete(np.arange(31), 15)):
        u = []
        for sign in (1, -1):
            x = state.positions.copy()
            x[bead, 2] += sign * h
            v = reference.velocity(x, modulus)[:, 2]
            u.append(np.delete(v - v[15], 15))
        assert np.abs((u[0] - u[1]) / (2 * h) - matrix[:, column]).max() < 1e-6 * np.abs(matrix).max()


def test_a_turn_about_gravity_is_neutral_and_left_out():
    """A x = 0 on a terminal shape: of the eigenvalues one is zero, and it is not the leading rate."""
    state = steady_state(1000)
    matrix = transverse_matrix(assemble(Scene(1000, 0.5, space="volume")), state.positions)
    rates = np.sort(np.linalg.eigvals(matrix).real)[::-1]
    assert abs(rates[0]) < 1e-9 and rates[1] < -0.01
    assert leading_rate(matrix, state.positions) == pytest.approx(rates[1])
    assert leading_rate(matrix, None) == pytest.approx(rates[0], abs=1e-9)


def test_growth_on_the_way_matters_though_the_end_is_stable():
    """A fiber along the compressive axis of an extension buckles in any direction before it is pulled straight."""
    flow = {"name": "extension", "rate": 0.02}
    moved = {"amplitude": 1e-3, "direction": "in-plane"}
    squeezed = Scene(
        20000, np.pi / 2, gravity=None, flow=flow, contact={}, hydrodynamics="RPY-overlap", disturbance=moved
    )
    audit_of = simulate(squeezed, Numerics(t_end=400)).metadata["audit"]
    verdict = next(v for v in audit_of if v["effect"] == "third dimension")
    assert verdict["number"] < 0 and verdict["matters"]


def test_scenes_in_volume_and_with_noise_are_not_asked_about_the_plane():
    """Nothing is said where the question makes no sense."""
    for parts in ({"space": "volume"}, {"hydrodynamics": "RPY-overlap", "noise": {"peclet": 1e6}}):
        run = simulate(scene(**parts), Numerics(t_end=1.0))
        assert "third dimension" not in {v["effect"] for v in run.metadata["audit"]}
