"""Compiled kernels on disk that are as old as their sources.

numba keeps a compiled function beside its file, and compiles anew when that file changes; but the
functions that it calls are compiled into it, and those may stand in other files.  So when any file
of a folder of kernels changes, all that was compiled there is forgotten.
"""

from pathlib import Path

from sedfiber.atomic_file import write_text
from sedfiber.errors import InputError

_STAMP = "sources.txt"


def forget_stale_kernels(folder: Path) -> None:
    """Remove what numba compiled in ``folder`` unless its sources are those of the last time."""
    cache = folder / "__pycache__"
    now = "\n".join(f"{path.name} {path.stat().st_mtime_ns} {path.stat().st_size}" for path in _sources(folder))
    try:
        if (cache / _STAMP).read_text() == now:
            return
    except OSError:
        pass  # nothing was compiled here yet
    try:
        for path in (*cache.glob("*.nbi"), *cache.glob("*.nbc")):
            path.unlink(missing_ok=True)
        cache.mkdir(exist_ok=True)
        write_text(cache / _STAMP, now)
    except (OSError, InputError):
        pass  # a folder that cannot be written to: numba keeps its files elsewhere


def _sources(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.py"))
