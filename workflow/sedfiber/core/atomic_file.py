"""Files appear whole or not at all: written under a temporary name, then renamed."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sedfiber.core.errors import InputError


def require_writable(path: Path) -> None:
    """Raise InputError, before any work, for an output whose folder cannot take a new file."""
    folder = path.parent
    if not folder.is_dir():
        raise InputError(f"output: folder {str(folder)!r} does not exist; create it or give another path")
    if path.is_dir():
        raise InputError(f"output: {str(path)!r} is a folder; give the path of a file")
    if not os.access(folder, os.W_OK):
        raise InputError(f"output: folder {str(folder)!r} is not writable; give another path")


def require_parquet(path: Path) -> None:
    """Raise InputError, before any work, for an output that cannot become a Parquet file."""
    require_writable(path)
    if path.suffix != ".parquet":
        raise InputError(f"output: {str(path)!r} is written as Parquet; give a name that ends in .parquet")


def require_folder(folder: Path) -> None:
    """Make an output folder; raise InputError, before any work, for one that cannot take files."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"output: cannot make the folder {str(folder)!r} ({error.strerror})") from None
    require_writable(folder / "card.json")


@contextmanager
def replaced_when_done(path: Path) -> Iterator[Path]:
    """A temporary path beside ``path`` that takes its name when the block ends well."""
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        yield partial
        with partial.open("rb+") as handle:
            os.fsync(handle.fileno())
        partial.replace(path)
    except OSError as error:
        raise InputError(f"output: cannot write {str(path)!r} ({error.strerror or error})") from None
    finally:
        partial.unlink(missing_ok=True)


def write_bytes(path: Path, content: bytes) -> None:
    """Write bytes so that they appear whole or not at all."""
    with replaced_when_done(path) as partial:
        partial.write_bytes(content)


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text so that it appears whole or not at all."""
    write_bytes(path, text.encode())
