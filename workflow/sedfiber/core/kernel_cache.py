"""Compiled kernels, kept on disk for as long as the sources of their folder stay the same.

numba keeps a compiled function beside its file and compiles it again when that file changes. The
functions that it calls are compiled into it, and they may stand in other files of the folder, so
the stamp of a kernel here is a checksum of all of them.
"""

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from numba import njit
from numba.core import caching
from numba.extending import intrinsic

Function = TypeVar("Function", bound=Callable[..., Any])


def kept(**options: Any) -> Callable[[Function], Function]:
    """Compile with these options of ``numba.njit``, and keep the result on disk."""

    def compiled(function: Function) -> Function:
        dispatcher = njit(**options)(function)
        dispatcher._cache = _KernelCache(function)  # what enable_caching() does, with our stamp
        return dispatcher

    return compiled


def inlined(generator: Callable[..., Any]) -> Callable[..., Any]:
    """Code that is written into the kernels that call it, without the typing context, its first argument."""
    return intrinsic(generator)


def sources_stamp(folder: Path) -> str:
    """Checksum of the name and content of every Python file of a folder."""
    digest = hashlib.sha256()
    for path in sorted(folder.glob("*.py")):
        digest.update(f"{path.name}\0".encode() + path.read_bytes())
    return digest.hexdigest()


_stamp_of_folder = cache(sources_stamp)


class _Stamped:
    """A place for compiled kernels whose stamp is that of the folder."""

    _py_file: str

    def get_source_stamp(self) -> str:
        return _stamp_of_folder(Path(self._py_file).parent)


class _UserProvided(_Stamped, caching.UserProvidedCacheLocator):
    pass


class _InTree(_Stamped, caching.InTreeCacheLocator):
    pass


class _UserWide(_Stamped, caching.UserWideCacheLocator):
    pass


class _KernelCacheImpl(caching.CompileResultCacheImpl):
    _locator_classes = [_UserProvided, _InTree, _UserWide]  # noqa: RUF012, numba reads a list


class _KernelCache(caching.FunctionCache):
    _impl_class = _KernelCacheImpl
