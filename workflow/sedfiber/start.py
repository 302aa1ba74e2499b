"""Where the beads are at t = 0."""

import math
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sedfiber._typing import Positions
from sedfiber.errors import InputError
from sedfiber.scene_parts import Disturbance, Fiber
from sedfiber.validation import refused

if TYPE_CHECKING:
    from sedfiber.scene import Scene

REST = "rest"


def start_positions(scene: "Scene") -> Positions:
    """Every fiber at its place and angle, disturbed if the scene says so, shape (beads, d)."""
    fibers = [_fiber_start(scene, fiber) for fiber in scene.fibers or (Fiber(),)]
    x = np.vstack(fibers)
    return x if scene.disturbance is None else x + _displacement(scene.disturbance, x.shape, scene.seed)


def fiber_angle(scene: "Scene", fiber: Fiber) -> float:
    """The fiber's inclination, or the scene's, or the seeded tilt where a straight start is exactly horizontal."""
    theta0 = scene.theta0 if fiber.theta0 is None else fiber.theta0
    if theta0 != 0.0 or scene.tilt == 0.0 or scene.shape is not None:
        return theta0
    return scene.tilt * float(np.random.default_rng(scene.seed).choice([1.0, -1.0]))


def _fiber_start(scene: "Scene", fiber: Fiber) -> Positions:
    """One fiber, shape (N, d): turned about its centre bead, and put in its place."""
    angle = fiber_angle(scene, fiber)
    # exactly vertical means exactly: cos(π/2) is 6e-17 and would seed a buckling
    cos = 0.0 if abs(angle) == math.pi / 2 else math.cos(angle)
    sin = math.sin(angle)
    shape = _shape(scene)
    x = np.zeros((scene.n_beads, scene.dim))
    x[:, 0] = shape[:, 0] * cos - shape[:, 1] * sin
    x[:, 1] = shape[:, 0] * sin + shape[:, 1] * cos
    x[:, 2:] = shape[:, 2 : scene.dim]
    return x + np.array(fiber.place[: scene.dim])


def _shape(scene: "Scene") -> Positions:
    """The shape before it is turned, centre bead at the origin, (N, 3)."""
    n = scene.n_beads
    if scene.shape == REST and scene.bending is not None and scene.bending.curvature != 0.0:
        from sedfiber.physics.curved_bending import rest_arc  # compiled: only for those who ask

        return rest_arc(n, scene.bending.curvature, 3)
    if scene.shape is None or scene.shape == REST:
        straight = np.zeros((n, 3))
        straight[:, 0] = 2.0 * (np.arange(n) - n // 2)
        return straight
    x = np.array(scene.shape)
    return x - x[n // 2]


def _displacement(disturbance: Disturbance, shape: tuple[int, int], seed: int) -> Positions:
    """Independent and uniform between ± amplitude, in the plane or out of it."""
    moves = np.random.default_rng(seed).uniform(-disturbance.amplitude, disturbance.amplitude, (shape[0], 3))
    moves[:, 2 if disturbance.direction == "in-plane" else slice(2)] = 0.0
    return moves[:, : shape[1]]


def read_shape(value: Any, n_beads: int, dim: int) -> Any:
    """A start shape as the scene keeps it: None, "rest", or N rows of three numbers; raises InputError."""
    if value is None or (isinstance(value, str) and value in ("none", "straight")):
        return None
    if isinstance(value, str) and value == REST:
        return REST
    if isinstance(value, dict) and set(value) == {"file"}:
        return read_shape(_from_file(Path(str(value["file"]))), n_beads, dim)
    allowed = f"straight, rest, {{file: PATH}}, or {n_beads} rows of 2 or 3 finite numbers"
    try:
        x = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise refused("shape", _shown(value), allowed) from None
    if x.ndim == 2 and x.shape[1] in (2, 3) and len(x) != n_beads:
        raise InputError(f"shape: a row count of {len(x)} is not allowed; give {n_beads} rows, one a bead (n_beads)")
    if x.shape not in ((n_beads, 2), (n_beads, 3)):
        raise refused("shape", _shown(value), allowed)
    if not np.isfinite(x).all():
        row = int(np.flatnonzero(~np.isfinite(x).all(axis=1))[0])
        raise InputError(f"shape: row {row + 1}, {x[row].tolist()}, is not allowed; give {allowed}")
    if dim == 2 and x[:, 2:].any():
        raise InputError("shape: leaves the plane z = 0 of a planar scene; give space: volume")
    padded = np.zeros((n_beads, 3))
    padded[:, : x.shape[1]] = x
    return tuple(map(tuple, padded.tolist()))


def _from_file(path: Path) -> Positions:
    """Rows of numbers (.csv, .npy), or the last sample of a trajectory (.parquet)."""
    if path.suffix == ".parquet":
        from sedfiber.trajectory_file import read_trajectory  # Arrow: only for those who ask

        try:
            return read_trajectory(path).positions[-1]
        except InputError as error:
            raise InputError(f"shape.file: {error}") from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # an empty file has no rows, which is said below
            npy = path.suffix == ".npy"
            return np.load(path, allow_pickle=False) if npy else np.loadtxt(path, delimiter=",", ndmin=2)
    except (OSError, ValueError, EOFError) as error:
        why = str(error).splitlines()[0]
        raise InputError(
            f"shape.file: cannot read {str(path)!r} ({why}); give .csv (a row of 2 or 3 numbers for each bead, with "
            "commas and without a header), .npy or a trajectory"
        ) from None


def _shown(value: Any) -> Any:
    """A value as an error shows it: short, on one line."""
    text = " ".join(str(value).split())
    return text if len(text) <= 60 else text[:57] + "…"
