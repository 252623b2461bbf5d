# SPDX-License-Identifier: Apache-2.0
"""Calls of the C library: texts, structs, and the lifetime of objects."""
from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

try:
    from ._native import ffi, lib
except ImportError as error:
    raise ImportError(f"mxgen cannot load its native module: {error}. It needs libxml2 (Debian: libxml2), and the"
                      " Debian package needs libmxgen0") from error

from .error import ArgumentError, CancelledError, Error, InternalError, OutOfMemoryError

__all__ = ["ffi", "lib", "Handle", "Native", "c_path", "c_text", "error_of", "fields", "keep_text", "py_text", "record",
           "sized_text"]


# ---- Texts ----

def c_text(value: str, what: str) -> bytes:
    """A text for C. `what` names the argument in the TypeError."""
    if not isinstance(value, str):
        raise TypeError(f"{what} must be str, not {type(value).__name__}")
    if "\0" in value:
        raise ValueError(f"{what} contains a NUL character")
    return value.encode("utf-8", "surrogateescape")


def c_path(value: str | os.PathLike[str], what: str) -> bytes:
    """The path of a file for C."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{what} must be str or os.PathLike, not {type(value).__name__}")
    return c_text(os.fspath(value), what)


def keep_text(text: bytes, keep: list[Any]) -> Any:
    """A C string for a struct; it lives as long as `keep`."""
    made = ffi.new("char[]", text)
    keep.append(made)
    return made


def py_text(text: Any) -> str:
    """The text of a `const char *` that is not NULL."""
    decoded: str = ffi.string(text).decode("utf-8", "surrogateescape")
    return decoded


def sized_text(write: Callable[[Any, int], Any]) -> str:
    """The text of a function that writes into a buffer and returns the full length."""
    size = write(ffi.NULL, 0)
    buffer = ffi.new("char[]", size + 1)
    write(buffer, size + 1)
    return py_text(buffer)


# ---- Structs ----

def _py_value(value: Any, ctype: Any) -> Any:
    if ctype.kind == "pointer":
        return py_text(value) if value else None
    if ctype.kind == "array":
        return tuple(_py_value(item, ctype.item) for item in value)
    return value


def fields(struct: Any) -> dict[str, Any]:
    """The members of a struct as Python values; a text that is NULL becomes None."""
    members = ffi.typeof(struct).item.fields
    return {name: _py_value(getattr(struct, name), member.type) for name, member in members if name != "size"}


def record(ctype: str, function: Callable[..., int], *arguments: Any) -> dict[str, Any] | None:
    """The struct that a function fills; None if the function refuses its arguments."""
    out = ffi.new(f"{ctype} *", {"size": ffi.sizeof(ctype)})
    status = function(*arguments, out)
    if status == lib.MXG_ERROR_ARGUMENT:
        return None
    if status != lib.MXG_OK:
        raise error_of(status)
    return fields(out)


# ---- Errors ----

_ERRORS: dict[int, type[Error]] = {
    lib.MXG_ERROR_ARGUMENT: ArgumentError,
    lib.MXG_ERROR_MEMORY: OutOfMemoryError,
    lib.MXG_ERROR_CANCELLED: CancelledError,
}


def error_of(status: int, reason: str = "") -> Error:
    """The exception for a status that is neither MXG_OK nor MXG_ERROR_DOCUMENT."""
    return _ERRORS.get(status, InternalError)(reason or py_text(lib.mxg_status_string(status)))


# ---- Lifetime ----

class Handle:
    """A native object. It ends after its owner and after every object that was made from it, in whatever order Python's garbage
    collector ends their owners: a child counts as an owner of its parents."""

    __slots__ = ("pointer", "_destroy", "_parents", "_further_owners")

    def __init__(self, pointer: Any, destroy: Callable[[Any], None], parents: tuple[Handle, ...] = ()) -> None:
        self.pointer = pointer
        self._destroy = destroy
        self._parents = parents
        # A list, because its methods are atomic: one item for each owner beside the first.
        self._further_owners: list[None] = []
        for parent in parents:
            parent._further_owners.append(None)

    def release(self) -> None:
        """Ends the share of one owner."""
        try:
            self._further_owners.pop()
        except IndexError:
            self._destroy(self.pointer)
            self.pointer = ffi.NULL
            for parent in self._parents:
                parent.release()


class Native:
    """A Python object that owns a handle."""

    _handle: Handle

    def __del__(self) -> None:
        handle = getattr(self, "_handle", None)
        if handle is not None:
            handle.release()

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError(f"{type(self).__name__} is a native object, which cannot be copied or pickled")
