# SPDX-License-Identifier: Apache-2.0
"""Diagnostics: the errors, warnings and notes of a document, library or call."""
from __future__ import annotations

import ctypes
import enum
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, overload

from ._calls import Handle, Native, lib, py_text, record, sized_text


class Severity(enum.IntEnum):
    """How bad a diagnostic is."""

    ERROR = lib.MXG_SEVERITY_ERROR
    WARNING = lib.MXG_SEVERITY_WARNING
    NOTE = lib.MXG_SEVERITY_NOTE


def _line_of(source: str, number: int) -> str | None:
    """A line of a text, from 1, without its end."""
    lines = source.split("\n", number)
    return lines[number - 1].removesuffix("\r") if 0 < number <= len(lines) else None


@dataclass(frozen=True)
class Diagnostic:
    """One diagnostic."""

    severity: Severity
    #: stable, for example "type-mismatch"
    id: str
    #: one line, without the place
    message: str
    #: None: no file
    file: str | None
    #: from 1, columns in code points; 0: unknown
    line: int
    column: int
    length: int
    #: for a note: the index of its error or warning; otherwise its own index
    parent: int
    #: what the format of the kind (`DiagnosticKind.message`) leaves open, as texts in its order
    arguments: tuple[str, ...]
    #: the path of an element that an edit added and that has no line; otherwise ""
    path: str
    _list: Diagnostics = field(repr=False, compare=False)
    _index: int = field(repr=False, compare=False)

    @property
    def notes(self) -> tuple[Diagnostic, ...]:
        """The notes that explain this error or warning."""
        found = []
        for other in self._list[self._index + 1:]:
            if other.parent != self._index:
                break
            found.append(other)
        return tuple(found)

    def format(self, source: str | None = None, *, line: str | None = None, colour: bool = False) -> str:
        """The diagnostic as compilers write it. With `source`, the text of the file, or `line`, the text of the line, the output
        shows the line with a caret."""
        if source is not None and line is not None:
            raise ValueError("source and line exclude each other")
        for name, text in ("source", source), ("line", line):
            if text is not None and not isinstance(text, str):
                raise TypeError(f"{name} must be str, not {type(text).__name__}")
        return self._list._text(self._index, _line_of(source, self.line) if source is not None else line, bool(colour))

    def __str__(self) -> str:
        return self.format()


class _Share(Native):
    """Holds a native object as long as its diagnostics are used, also after its `close`."""

    def __init__(self, owner: Native) -> None:
        self._handle = Handle(None, lambda pointer: None, (owner._handle,))


class Diagnostics(Sequence[Diagnostic]):
    """The diagnostics of a document, library or call, in order of discovery. Notes follow the diagnostic that they explain.

    They can be pickled, also as part of a `DocumentError`. `format` of the copy takes no line of the source."""

    def __init__(self, pointer: Any, owner: Native) -> None:
        self._pointer = pointer
        self._share = _Share(owner)

    def __len__(self) -> int:
        return int(lib.mxg_diagnostics_num_items(self._pointer))

    def _values(self, place: int) -> dict[str, Any]:
        """The fields of a diagnostic."""
        values = record("mxg_diagnostic", lib.mxg_diagnostics_item, self._pointer, place)
        assert values is not None
        values["severity"] = Severity(values["severity"])
        values["arguments"] = tuple(py_text(lib.mxg_diagnostics_argument(self._pointer, place, argument))
                                    for argument in range(values.pop("num_arguments")))
        return values

    def _text(self, place: int, line: str | None, colour: bool) -> str:
        """A diagnostic as compilers write it."""
        data = None if line is None else line.encode("utf-8", "surrogateescape")
        size = 0 if data is None else len(data)
        return sized_text(lambda out, capacity: lib.mxg_diagnostics_format(self._pointer, place, data, size, colour, out, capacity))

    def __reduce__(self) -> Any:
        places = range(len(self))
        return _Copy, (tuple(self._values(place) for place in places),
                       tuple((self._text(place, None, False), self._text(place, None, True)) for place in places), self.errors)

    @overload
    def __getitem__(self, index: int) -> Diagnostic: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Diagnostic]: ...

    def __getitem__(self, index: int | slice) -> Diagnostic | Sequence[Diagnostic]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        place = range(len(self))[index]
        return Diagnostic(**self._values(place), _list=self, _index=place)

    @property
    def errors(self) -> int:
        """The number of errors, including those beyond `max_errors` of the context."""
        return int(lib.mxg_diagnostics_num_errors(self._pointer))

    @property
    def warnings(self) -> int:
        """The number of warnings."""
        return sum(diagnostic.severity is Severity.WARNING for diagnostic in self)

    def format(self, source: str | None = None, *, colour: bool = False) -> str:
        """All diagnostics as compilers write them."""
        return "\n".join(diagnostic.format(source, colour=colour) for diagnostic in self)

    def __str__(self) -> str:
        return self.format()

    def __repr__(self) -> str:
        return f"<Diagnostics: {self.errors} errors, {self.warnings} warnings>"


class _Copy(Diagnostics):
    """Diagnostics that came from another process, or were copied: the texts without lines of the source."""

    def __init__(self, values: tuple[dict[str, Any], ...], texts: tuple[tuple[str, str], ...], errors: int) -> None:
        self._content = values, texts, errors

    def __len__(self) -> int:
        return len(self._content[0])

    def _values(self, place: int) -> dict[str, Any]:
        return self._content[0][place]

    def _text(self, place: int, line: str | None, colour: bool) -> str:
        if line is not None:
            raise ValueError("a copied diagnostic cannot show a line of the source; the original can")
        return self._content[1][place][colour]

    def __reduce__(self) -> Any:
        return _Copy, self._content

    @property
    def errors(self) -> int:
        return self._content[2]


@dataclass(frozen=True)
class DiagnosticKind:
    """A diagnostic that mxgen can report: `mxgen explain`."""

    id: str
    #: the default; the context's `warnings` can change it
    severity: Severity
    #: a format with %s and %u
    message: str
    cause: str
    cure: str
    #: an example as a diff (include/mxgen/catalogue.h describes the format); "": no example
    example: str


def diagnostic_kinds() -> tuple[DiagnosticKind, ...]:
    """Every diagnostic that mxgen can report."""
    found = []
    for index in range(lib.mxg_catalogue_num_diagnostic_kinds()):
        values = record("mxg_diagnostic_kind", lib.mxg_catalogue_diagnostic_kind, index)
        assert values is not None
        values["severity"] = Severity(values["severity"])
        found.append(DiagnosticKind(**values))
    return tuple(found)


def color_difference(a: Sequence[float], b: Sequence[float]) -> float:
    """CIEDE2000 between two linear colours of Rec. 709."""
    if len(a) != 3 or len(b) != 3:
        raise ValueError("a colour has three numbers")
    return float(lib.mxg_color_difference((ctypes.c_float * 3)(*a), (ctypes.c_float * 3)(*b)))


def library_version() -> str:
    """The version of the C library."""
    return py_text(lib.mxg_version_string())
