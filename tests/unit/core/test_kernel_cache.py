"""Compiled kernels must not outlive the sources of what they call."""

from sedfiber.core.kernel_cache import sources_stamp
from sedfiber.physics.gaps import closest_distance


def test_the_stamp_of_a_folder_changes_with_any_source_and_with_nothing_else(tmp_path):
    """A kernel compiled into another file counts; a compiled file beside them does not."""
    for name in ("caller.py", "called.py"):
        (tmp_path / name).write_text("x = 1\n")
    before = sources_stamp(tmp_path)
    (tmp_path / "other.nbi").write_text("")
    assert sources_stamp(tmp_path) == before
    (tmp_path / "called.py").write_text("x = 2\n")
    changed = sources_stamp(tmp_path)
    (tmp_path / "called.py").rename(tmp_path / "renamed.py")
    assert len({before, changed, sources_stamp(tmp_path)}) == 3


def test_a_kernel_is_kept_under_the_stamp_of_its_folder():
    """numba reads the stamp from the kernel's cache, and compiles again when it is another."""
    import sedfiber.physics

    (folder,) = sedfiber.physics.__path__
    from pathlib import Path

    cache = closest_distance._cache
    assert cache._impl.locator.get_source_stamp() == sources_stamp(Path(folder))
