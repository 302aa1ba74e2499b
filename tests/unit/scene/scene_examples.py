"""Every part of a scene with all its parameters, on a small fiber; and the line with which a scene is refused."""

import pytest

from sedfiber import InputError, Scene

BASE = {"B": 1000.0, "theta0": 0.7, "n_beads": 5}
WALL = {"point": [0.0, -50.0, 0.0], "normal": [0.6, 0.8, 0.0]}
OWN = [{"file": "trap.py", "effect": "Trap", "parameters": {"stiffness": 0.5}}]
# Every part with all its parameters; lists hold several of one part.
EXAMPLES = {
    "gravity": [{"direction": [0.6, -0.8, 0.0], "strength": 2.0}],
    "stretching": [{"factor": 3.0}],
    "bending": [{"curvature": 0.05}],
    "wall": [WALL],
    "flow": [
        {"name": "shear", "rate": 0.1, "couple": False},
        {"name": "parabolic", "peak": 2.0, "half_width": 30.0, "couple": True},
        {"gradient": [[0.1, 0.2, 0.0], [0.0, -0.1, 0.0], [0.0, 0.0, 0.0]], "couple": True},
    ],
    "contact": [{"strength": 5.0, "reach": 2.5}],
    "noise": [{"peclet": 10.0, "step": 0.05}],
    "disturbance": [{"amplitude": 0.1, "direction": "in-plane"}],
    "fibers": [{"B": 500.0, "theta0": -0.2, "place": [1.0, 30.0, 0.0]}],
    "own": OWN,
}
LISTS = ("fibers", "own")


def refusal(**values):
    """The one line with which a scene is refused."""
    with pytest.raises(InputError) as error:
        Scene(**(BASE | values))
    assert "\n" not in str(error.value)
    return str(error.value)
