import numpy as np
import pandas as pd
import pytest

from sedfiber.core.errors import InputError
from sedfiber.reduced.dataset import mirrored, read_dataset
from tiny_fiber import N_BEADS, NAMES, TRAINED, bent_fiber, settling


def write_pair(folder, trajectories):
    """The Parquet pair as the workflow writes it."""
    tables = []
    for one in trajectories:
        table = pd.DataFrame(one.positions.reshape(len(one.t), -1), columns=NAMES)
        facts = {"B": one.B, "theta0": one.theta0, "angle_index": one.angle_index, "split": one.split, "t": one.t}
        tables.append(table.assign(**facts))
    samples, steady = folder / "samples.parquet", folder / "terminal.parquet"
    pd.concat(tables).to_parquet(samples)
    shapes = {one.B: one for one in trajectories}.values()
    rows = [dict(zip(NAMES, one.terminal.ravel(), strict=True)) | {"B": one.B} for one in shapes]
    velocities = [
        dict(zip(("velocity_x", "velocity_y", "velocity_z"), one.terminal_velocity, strict=True)) for one in shapes
    ]
    pd.DataFrame([row | more for row, more in zip(rows, velocities, strict=True)]).to_parquet(steady)
    return samples, steady


def test_reads_back_what_was_written(tmp_path, training):
    read = read_dataset(*write_pair(tmp_path, training))
    assert len(read) == len(training) and read.n_beads == N_BEADS
    assert read.B_values.tolist() == list(TRAINED)
    for one, other in zip(training, read, strict=True):
        assert (one.B, one.angle_index, one.theta0, one.split) == (
            other.B,
            other.angle_index,
            other.theta0,
            other.split,
        )
        for name in ("t", "positions", "terminal", "terminal_velocity"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_value_that_is_not_finite_is_named(tmp_path):
    good, bad = settling(100.0, 6), settling(300.0, 12)
    bad.positions[3, 1, 0] = np.nan
    with pytest.raises(InputError, match="B = 300, angle_index = 12"):
        read_dataset(*write_pair(tmp_path, [good, bad]))


def test_truncated_file_is_refused(tmp_path, training):
    samples, steady = write_pair(tmp_path, training)
    samples.write_bytes(samples.read_bytes()[:1000])
    with pytest.raises(InputError, match="cannot read"):
        read_dataset(samples, steady)


def test_missing_terminal_shape_is_named(tmp_path, training):
    samples, steady = write_pair(tmp_path, training)
    table = pd.read_parquet(steady)
    table[table["B"] != 300.0].to_parquet(steady)
    with pytest.raises(InputError, match="no terminal shape for B = 300"):
        read_dataset(samples, steady)


def test_missing_column_is_named(tmp_path, training):
    samples, steady = write_pair(tmp_path, training)
    pd.read_parquet(samples).drop(columns="y2").to_parquet(samples)
    with pytest.raises(InputError, match="y2"):
        read_dataset(samples, steady)


def test_mirror_turns_the_angle_round_and_is_its_own_inverse():
    bend = np.array([0.2])
    tilted = bent_fiber(np.array([0.4]), bend)
    np.testing.assert_allclose(mirrored(tilted), bent_fiber(np.array([-0.4]), bend), atol=1e-14)
    np.testing.assert_array_equal(mirrored(mirrored(tilted)), tilted)
