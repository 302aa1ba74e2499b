"""Checksums of files and of bytes."""

import hashlib
from pathlib import Path

from sedfiber.core.errors import InputError


def sha256_of_bytes(content: bytes) -> str:
    """SHA-256 in hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def sha256(path: Path) -> str:
    """SHA-256 of a file in hexadecimal; raises InputError where it cannot be read."""
    try:
        with path.open("rb") as handle:
            return hashlib.file_digest(handle, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"input: cannot read {str(path)!r} ({error.strerror})") from None
