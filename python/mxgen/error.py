# SPDX-License-Identifier: Apache-2.0
"""Exceptions. Each has a text that names the fault."""
from __future__ import annotations

from errno import ENOENT
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .diagnostic import Diagnostics
    from .document import Document


class Error(Exception):
    """The base class of mxgen's exceptions."""


class ArgumentError(Error, ValueError):
    """A value that the call does not accept: an unknown target, option or path."""


class EditError(ArgumentError):
    """An edit that cannot be made. The document under construction is as it was before the call."""


class OutOfMemoryError(Error, MemoryError):
    """The machine has no memory left, or the context reached `max_memory`."""


class CancelledError(Error):
    """The callback `cancel` returned True."""


class InternalError(Error):
    """A bug in mxgen."""


class DocumentError(Error):
    """A document, library or request has errors. The text lists them. From another process it comes without the document."""

    #: every diagnostic of the call
    diagnostics: Diagnostics
    #: the document with its errors, where the call made one: the parts without errors can be used
    document: Document | None

    def __init__(self, diagnostics: Diagnostics, document: Document | None = None) -> None:
        super().__init__(diagnostics.format())
        self.diagnostics = diagnostics
        self.document = document

    def __reduce__(self) -> Any:
        return type(self), (self.diagnostics,)


class MissingFileError(DocumentError, FileNotFoundError):
    """The file that the caller names does not exist, or one that it includes."""

    def __init__(self, diagnostics: Diagnostics, document: Document | None = None) -> None:
        super().__init__(diagnostics, document)
        self.errno = ENOENT


def document_error(diagnostics: Diagnostics, document: Document | None = None) -> DocumentError:
    """The exception for the diagnostics of a call."""
    is_missing = len(diagnostics) > 0 and diagnostics[0].id == "file-missing"
    return (MissingFileError if is_missing else DocumentError)(diagnostics, document)
