# SPDX-License-Identifier: Apache-2.0
"""Calls of the C library: texts, structs, and the lifetime of objects."""
from __future__ import annotations

import ctypes
import os
import pathlib
from collections.abc import Callable, Iterable
from types import TracebackType
from typing import Any, TypeVar, cast

from . import _native
from .error import ArgumentError, CancelledError, Error, InternalError, OutOfMemoryError

__all__ = ["Handle", "Native", "c_number", "c_path", "c_text", "c_texts", "error_of", "fields", "guarded", "lib", "new", "optional_text", "py_text",
           "record", "sized_text"]


# ---- The library ----

class _Library:
    """The functions and the constants of the C library."""

    def __init__(self) -> None:
        # A wheel and the build folder have the library beside this file; Debian has it where the loader looks.
        beside = pathlib.Path(__file__).with_name("libmxgen.so")
        try:
            loaded = ctypes.CDLL(str(beside) if beside.exists() else "libmxgen.so.0")
            for name, (result, arguments) in _native.FUNCTIONS.items():
                function = getattr(loaded, name)
                function.restype, function.argtypes = result, arguments
                setattr(self, name, function)
        except (OSError, AttributeError) as error:
            raise ImportError(f"mxgen cannot load its library: {error}. The Debian package needs libmxgen0, and a build without"
                              " libxml2 inside needs libxml2") from error
        for constants in _native.CONSTANTS, *_native.ENUMS.values():
            vars(self).update(constants)

    def __getattr__(self, name: str) -> Any: # tells type checkers that there are further attributes
        raise AttributeError(f"the library has no '{name}'")


lib = _Library()


# ---- Texts ----

def check_type(value: object, kind: type, what: str) -> None:
    """Refuses an argument of another type."""
    if not isinstance(value, kind):
        raise TypeError(f"{what} must be {kind.__name__}, not {type(value).__name__}")


def c_text(value: str, what: str) -> bytes:
    """A text for C. `what` names the argument in the TypeError."""
    if not isinstance(value, str):
        raise TypeError(f"{what} must be str, not {type(value).__name__}")
    if "\0" in value:
        raise ValueError(f"{what} contains a NUL character")
    return value.encode("utf-8", "surrogateescape")


def optional_text(value: str | None, what: str) -> bytes | None:
    """The same; None gives NULL."""
    return None if value is None else c_text(value, what)


def c_number(value: int, what: str, bits: int = 32, *, signed: bool = False) -> int:
    """A number for C, which would cut it."""
    low = -(1 << bits - 1) if signed else 0
    if not isinstance(value, int):
        raise TypeError(f"{what} must be int, not {type(value).__name__}")
    if not low <= value < low + (1 << bits):
        raise OverflowError(f"{what} is out of range: {value}")
    return value


def c_path(value: str | os.PathLike[str], what: str) -> bytes:
    """The path of a file for C."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{what} must be str or os.PathLike, not {type(value).__name__}")
    return c_text(os.fspath(value), what)


def c_texts(values: Iterable[bytes]) -> Any:
    """An array of texts for C."""
    texts = list(values)
    return (ctypes.c_char_p * len(texts))(*texts)


def py_text(text: bytes) -> str:
    """The text of a `const char *` that is not NULL."""
    return text.decode("utf-8", "surrogateescape")


def sized_text(write: Callable[[Any, int], Any]) -> str:
    """The text of a function that writes into a buffer and returns the full length."""
    size = write(None, 0)
    buffer = ctypes.create_string_buffer(size + 1)
    write(buffer, size + 1)
    return py_text(buffer.value)


# ---- Structs ----

def new(name: str, **members: Any) -> Any:
    """A struct with its size, if it has one, and the given members. It keeps alive what they point to."""
    struct = getattr(_native, name)
    if struct._fields_[0][0] == "size":
        members["size"] = ctypes.sizeof(struct)
    return struct(**members)


def fields(struct: Any) -> dict[str, Any]:
    """The members of a struct as Python values; a text that is NULL becomes None."""
    found = {}
    for name, _ in struct._fields_[1:]:
        value = getattr(struct, name)
        found[name] = py_text(value) if isinstance(value, bytes) else tuple(map(_item, value)) if isinstance(value, ctypes.Array) else value
    return found


def _item(value: Any) -> Any:
    return py_text(value) if isinstance(value, bytes) else value


def record(name: str, function: Callable[..., int], *arguments: Any) -> dict[str, Any] | None:
    """The struct that a function fills; None if the function refuses its arguments."""
    out = new(name)
    status = function(*arguments, out)
    if status == lib.MXG_ERROR_ARGUMENT:
        return None
    if status != lib.MXG_OK:
        raise error_of(status)
    return fields(out)


# ---- Callbacks ----

def guarded(name: str, keeper: Any, work: Callable[..., Any], failed: Any = None) -> Any:
    """A function for the parameter or member `name`, without its first parameter, the user data. An exception does not reach C:
    `keeper.raised` has it, and the callback returns `failed`; so do all after it until `keeper.raised` is None again, but those that free
    (`failed` None) always work."""

    def call(_user_data: Any, *arguments: Any) -> Any:
        try:
            return failed if keeper.raised is not None and failed is not None else work(*arguments)
        except BaseException as error: # pylint: disable=broad-except
            keeper.raised = keeper.raised or error
            return failed

    return cast(Any, getattr(_native, f"callback_{name}")(call))


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
            self.pointer = None
            for parent in self._parents:
                parent.release()


_Self = TypeVar("_Self", bound="Native")


class Native:
    """A Python object that owns a handle. It ends with its last reference, or at `close`, or at the end of a `with` block; objects that
    were made from it stay."""

    _handle: Handle

    def close(self) -> None:
        """Frees the memory of the object. Every later use of it raises Error."""
        handle = vars(self).pop("_handle", None)
        if handle is not None:
            handle.release()

    @property
    def _is_open(self) -> bool:
        return "_handle" in vars(self)

    def __repr__(self) -> str:
        return self._shown() if self._is_open else f"<{type(self).__name__}: ended>"

    def _shown(self) -> str:
        return f"<{type(self).__name__}>"

    def __getattr__(self, name: str) -> Any:
        if name == "_handle":
            raise Error(f"the {type(self).__name__.lower()} has ended")
        raise AttributeError(f"'{type(self).__name__}' has no attribute '{name}'")

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError(f"{type(self).__name__} is a native object, which cannot be copied or pickled")
