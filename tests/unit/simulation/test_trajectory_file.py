"""Trajectory files: exact, byte-identical, whole or not at all, and refused when damaged."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from sedfiber import InputError, Trajectory, read_trajectory, write_trajectory
from sedfiber.core.atomic_file import replaced_when_done, require_writable, write_text
from sedfiber.core.parquet_file import METADATA_KEY, bead_count, coordinate_names


@pytest.fixture
def trajectory():
    """Random positions that need all their digits, with nested metadata."""
    rng = np.random.default_rng(0)
    facts = {"B": 1000.0, "scene": {"theta0": 0.1 + 0.2}, "settling_time": None, "name": "ℬ"}
    return Trajectory(0.5 * np.arange(40), rng.normal(scale=1e3, size=(40, 5, 3)), facts)


@pytest.fixture
def written(trajectory, tmp_path):
    """The same on disk."""
    path = tmp_path / "traj.parquet"
    write_trajectory(trajectory, path)
    return path


def names_in(folder):
    """Everything in a folder, hidden files included."""
    return sorted(path.name for path in folder.iterdir())


def test_round_trip_is_exact(trajectory, written):
    """Every bit of every coordinate comes back, and the metadata with it."""
    back = read_trajectory(written)
    assert np.array_equal(back.t, trajectory.t)
    assert np.array_equal(back.positions, trajectory.positions)
    assert back.positions.dtype == np.float64
    assert back.metadata == trajectory.metadata


def test_layout_is_as_documented(trajectory, written):
    """DESIGN §3: t, then x0, y0, z0, …; one row a sample; JSON under the key `sedfiber`."""
    table = pq.read_table(written)
    assert table.column_names == ["t", "x0", "y0", "z0", *coordinate_names(5)[3:]]
    assert table.num_rows == 40
    assert list(table.schema.metadata) == [b"sedfiber"]
    assert np.array_equal(table.column("y3").to_numpy(), trajectory.positions[:, 3, 1])


def test_writing_again_gives_the_same_bytes(trajectory, written, tmp_path):
    """Whatever the file's name or the order of the metadata's keys."""
    other = tmp_path / "other.parquet"
    backwards = dict(reversed(trajectory.metadata.items()))
    write_trajectory(Trajectory(trajectory.t, trajectory.positions, backwards), other)
    assert other.read_bytes() == written.read_bytes()


def test_writing_replaces_an_older_file(trajectory, written):
    """A rerun takes the place of what was there; no temporary file stays behind."""
    shorter = Trajectory(trajectory.t[:3], trajectory.positions[:3], {"B": 1})
    write_trajectory(shorter, written)
    assert len(read_trajectory(written).t) == 3
    assert names_in(written.parent) == ["traj.parquet"]


def test_nan_in_the_metadata_is_refused(trajectory, tmp_path):
    """JSON has no NaN: the file would be unreadable elsewhere."""
    with pytest.raises(ValueError, match="JSON"):
        write_trajectory(Trajectory(trajectory.t, trajectory.positions, {"a": float("nan")}), tmp_path / "x.parquet")
    assert names_in(tmp_path) == []


def refused(path):
    """Reading raises one line that names the file; returns it."""
    with pytest.raises(InputError) as error:
        read_trajectory(path)
    message = str(error.value)
    assert str(path) in message
    assert "\n" not in message
    return message


@pytest.mark.parametrize("fraction", [0.0, 0.01, 0.3, 0.9, 0.999])
def test_truncated_files_are_refused(written, fraction):
    """A file cut off anywhere is not a trajectory."""
    whole = written.read_bytes()
    written.write_bytes(whole[: int(fraction * len(whole))])
    assert "damaged or truncated" in refused(written)


def test_text_is_refused(tmp_path):
    """A CSV under the name of a Parquet file."""
    path = tmp_path / "traj.parquet"
    path.write_text("t,x0,y0,z0\n0,0,0,0\n")
    assert "not a readable Parquet file" in refused(path)


def test_missing_file_is_refused(tmp_path):
    """The message says that it is not there, rather than that it is damaged."""
    assert "does not exist" in refused(tmp_path / "none.parquet")


def test_foreign_parquet_is_refused(tmp_path):
    """Parquet without our metadata was written by something else."""
    path = tmp_path / "traj.parquet"
    pq.write_table(pa.table({"t": [0.0], "x0": [0.0], "y0": [0.0], "z0": [0.0]}), path)
    assert "no metadata" in refused(path)


@pytest.mark.parametrize("columns", [["x0", "y0", "z0"], ["t"], ["t", "x0", "y0"], ["t", "x0", "y0", "z0", "x1"], []])
def test_incomplete_columns_are_refused(tmp_path, columns):
    """A table of ours that is not a trajectory."""
    path = tmp_path / "traj.parquet"
    table = pa.table({name: pa.array([0.0]) for name in columns}).replace_schema_metadata({METADATA_KEY: b"{}"})
    pq.write_table(table, path)
    assert "not a trajectory" in refused(path)


def rewritten(path, change):
    """The file at ``path`` again, its table passed through ``change``."""
    pq.write_table(change(pq.read_table(path)), path)
    return path


def test_empty_trajectory_is_refused(written):
    """No sample, no trajectory."""
    assert "not a trajectory" in refused(rewritten(written, lambda table: table.slice(0, 0)))


def test_damaged_metadata_is_refused(written):
    """Metadata that is not JSON is one line, not a traceback."""
    refused(rewritten(written, lambda table: table.replace_schema_metadata({METADATA_KEY: b"{not json"})))


@pytest.mark.parametrize("values", [["text"] * 40, [None] * 40], ids=["text", "null"])
@pytest.mark.parametrize("column", ["t", "x0"])
def test_columns_that_are_not_numbers_are_refused(written, column, values):
    """Text would come back as an object array, nulls as NaN."""
    refused(rewritten(written, lambda table: _with_column(table, column, values)))


def _with_column(table, name, values):
    return table.set_column(table.column_names.index(name), name, pa.array(values))


def test_folder_is_refused(written):
    """A trajectory is one file."""
    refused(written.parent)


def test_flipped_bits_never_change_a_number(trajectory, written):
    """A damaged byte anywhere is either harmless or refused; 200 seeded flips."""
    whole, rng = written.read_bytes(), np.random.default_rng(0)
    for _ in range(200):
        damaged = bytearray(whole)
        damaged[rng.integers(len(whole))] ^= 1 << rng.integers(8)
        written.write_bytes(damaged)
        try:
            back = read_trajectory(written)
        except InputError:
            continue
        assert np.array_equal(back.positions, trajectory.positions)


def test_failed_write_leaves_the_old_file_and_nothing_else(trajectory, written, monkeypatch):
    """A full disk in the middle of writing: one line, the older file untouched, no temporary file."""
    before = written.read_bytes()

    def full_disk(table, path, **options):
        path.write_bytes(b"half of it")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(pq, "write_table", full_disk)
    with pytest.raises(InputError, match=r"^output: cannot write .*No space left on device") as error:
        write_trajectory(trajectory, written)
    assert "\n" not in str(error.value)
    assert written.read_bytes() == before
    assert names_in(written.parent) == ["traj.parquet"]


def test_vanished_folder_is_one_line(trajectory, tmp_path):
    """The folder was removed while the simulation ran."""
    with pytest.raises(InputError, match=r"^output: cannot write"):
        write_trajectory(trajectory, tmp_path / "gone" / "traj.parquet")


def test_interrupted_write_leaves_nothing(tmp_path):
    """Ctrl-C inside the block: neither the file nor its temporary name remains."""
    with pytest.raises(KeyboardInterrupt), replaced_when_done(tmp_path / "x") as partial:
        partial.write_text("half")
        raise KeyboardInterrupt
    assert names_in(tmp_path) == []


def test_file_appears_only_when_done(tmp_path):
    """Inside the block only the temporary name exists; a reader never sees half a file."""
    with replaced_when_done(tmp_path / "x") as partial:
        partial.write_text("half")
        assert not (tmp_path / "x").exists()
    assert (tmp_path / "x").read_text() == "half"


def test_text_is_utf8(tmp_path):
    """ℬ survives whatever the locale says."""
    write_text(tmp_path / "x", "ℬ = 24 N³/ℰ")
    assert (tmp_path / "x").read_bytes().decode("utf-8") == "ℬ = 24 N³/ℰ"


def test_outputs_are_checked_before_any_work(tmp_path, monkeypatch):
    """A missing folder, a folder in place of a file, a read-only folder: each named at once."""
    require_writable(tmp_path / "x")
    with pytest.raises(InputError, match="does not exist"):
        require_writable(tmp_path / "no" / "x")
    with pytest.raises(InputError, match="is a folder"):
        require_writable(tmp_path)
    monkeypatch.setattr("os.access", lambda path, mode: False)  # as root every folder is writable
    with pytest.raises(InputError, match="not writable"):
        require_writable(tmp_path / "x")


def test_column_names_count_beads():
    """x0, y0, z0, x1, …; a gap in the numbering is not a bead count."""
    assert coordinate_names(2) == ["x0", "y0", "z0", "x1", "y1", "z1"]
    assert bead_count(["t", *coordinate_names(31)]) == 31
    assert bead_count(["t", "x0", "y0", "z0", "x2", "y2", "z2"]) == 0
    assert bead_count(["t", "xray"]) == 0


def test_a_trajectory_shows_itself_in_one_line(trajectory):
    """What a user sees who prints it; not its numbers."""
    shown = repr(trajectory)
    assert "\n" not in shown and len(shown) < 120
    assert f"{len(trajectory.t)} samples" in shown and f"{trajectory.positions.shape[1]} beads" in shown
