"""Compiled kernels must not outlive the sources of what they call."""

import os

from sedfiber.kernel_cache import forget_stale_kernels


def test_kernels_are_kept_while_no_source_changes_and_forgotten_when_one_does(tmp_path):
    """Any file of the folder counts; other files beside the kernels stay."""
    (tmp_path / "__pycache__").mkdir()
    for name in ("caller.py", "called.py"):
        (tmp_path / name).write_text("x = 1\n")
    forget_stale_kernels(tmp_path)
    compiled = [tmp_path / "__pycache__" / f"caller.f-1.py311{end}" for end in (".nbi", ".1.nbc")]
    other = tmp_path / "__pycache__" / "caller.cpython-311.pyc"
    for path in (*compiled, other):
        path.write_text("")
    forget_stale_kernels(tmp_path)
    assert all(path.exists() for path in compiled)
    os.utime(tmp_path / "called.py", ns=(0, 0))
    forget_stale_kernels(tmp_path)
    assert not any(path.exists() for path in compiled) and other.exists()


def test_a_folder_that_cannot_be_written_to_is_left_alone(tmp_path):
    """As where the package is installed for all users; here the cache's place is taken by a file."""
    (tmp_path / "kernel.py").write_text("x = 1\n")
    (tmp_path / "__pycache__").write_text("")
    forget_stale_kernels(tmp_path)
    assert (tmp_path / "__pycache__").is_file()
