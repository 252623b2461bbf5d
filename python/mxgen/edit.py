# SPDX-License-Identifier: Apache-2.0
"""Edits: documents made from nothing or from other documents."""
from __future__ import annotations

import ctypes
import re
from collections.abc import Iterable
from numbers import Real
from types import TracebackType
from typing import TYPE_CHECKING, Any, Union

from ._calls import Handle, Native, c_text, error_of, lib, optional_text, sized_text
from .definition import Library
from .document import Document, Element
from .error import EditError, Error, document_error

if TYPE_CHECKING:
    from .context import Context

#: A value for an input: the text of any type, or a number, a boolean, or the components of a colour, vector or matrix, also in an array
#: of NumPy or nested.
NewValue = Union[bool, int, float, str, Iterable[Any]]


def _reason_of(pointer: Any) -> str:
    return sized_text(lambda out, capacity: lib.mxg_edit_error(pointer, out, capacity))


class Draft:
    """An element of an edit. Its methods change the edit."""

    __slots__ = ("edit", "number")

    def __init__(self, edit: Edit, number: int) -> None:
        self.edit = edit
        #: the number of the element in the document that the edit makes
        self.number = number

    @property
    def element(self) -> Element:
        """The element of the document that the edit made. Raises ArgumentError if the edit has removed it."""
        return Element(self.edit.document, self.number)

    def add(self, category: str, name: str | None = None, type: str | None = None) -> Draft:
        """Appends an element below. The name must be new there."""
        return self.edit._made(lib.mxg_edit_add_element, self.number, c_text(category, "category"), optional_text(name, "name"),
                               optional_text(type, "type"))

    def child(self, name: str) -> Draft | None:
        """The element of a name directly below."""
        path = c_text(name, "name")
        number = lib.mxg_edit_find_element(self.edit._pointer(), self.number, path) if path else 0
        return Draft(self.edit, number) if number else None

    def unique_name(self, name: str) -> str:
        """A name that is new below the element: this one, with '_' for what no name can have, or the same with the next free number."""
        made = re.sub(r"\W", "_", name, flags=re.ASCII)
        made = made if made and not made[0].isdigit() else f"_{made}"
        stem = made.rstrip("0123456789")
        number, known = int(made[len(stem):] or 1), self.edit._numbers
        while self.child(made) is not None:
            number = max(number, known.get((self.number, stem), 0)) + 1
            made = f"{stem}{number}"
            known[self.number, stem] = number - 1  # all up to it are taken
        return made

    def set(self, attribute: str, value: str | None) -> Draft:
        """Sets an attribute; None removes it."""
        self.edit._change(lib.mxg_edit_set_attribute, self.number, c_text(attribute, "attribute"), optional_text(value, "value"))
        return self

    def rename(self, name: str) -> Draft:
        """Renames the element, and changes the references to it."""
        self.edit._change(lib.mxg_edit_rename_element, self.number, c_text(name, "name"))
        return self

    def value(self, input: str, value: NewValue, type: str | None = None) -> Draft:
        """Gives an input of a node a value, and removes its connection. `type` None: the type of the input, or that of the definition."""
        name, kind = c_text(input, "input"), optional_text(type, "type")
        value = value.tolist() if hasattr(value, "tolist") else value # an array of NumPy may have no dimension
        if isinstance(value, (list, tuple)) and len(value) == 1 and isinstance(value[0], int):
            value = value[0]
        if isinstance(value, (str, int)): # a float has not every integer
            self.edit._change(lib.mxg_edit_set_value, self.number, name, kind, _text_of(value))
        else:
            numbers = _numbers_of(value)
            self.edit._change(lib.mxg_edit_set_numbers, self.number, name, kind, (ctypes.c_float * len(numbers))(*numbers), len(numbers))
        return self

    def connect(self, input: str | None, source: Draft | Element, output: str | None = None) -> Draft:
        """Connects an input of a node, or an <output> element (then `input` is None), to a node, a nodegraph or an input of the
        nodegraph around it. `output` None: the only output of the source."""
        self.edit._change(lib.mxg_edit_connect_input, self.number, optional_text(input, "input"), self.edit._own(source), optional_text(output, "output"))
        return self

    def remove(self) -> None:
        """Removes the element with all below it."""
        self.edit._change(lib.mxg_edit_remove_element, self.number)

    def move(self, parent: Draft | Element | None = None, before: Draft | Element | None = None) -> Draft:
        """Moves the element before another one (None: to the end) below `parent` (None: the root)."""
        numbers = [0 if other is None else self.edit._own(other) for other in (parent, before)]
        self.edit._change(lib.mxg_edit_move_element, self.number, *numbers)
        return self

    def flatten(self) -> None:
        """Replaces the node by the nodes of the nodegraph that implements its definition. Their names begin with its name, and the one
        behind its only output has the name itself."""
        self.edit._change(lib.mxg_edit_flatten_node, self.number)

    def copy(self, element: Element, name: str | None = None) -> Draft:
        """Appends a copy of an element of any document, with all below it."""
        if not isinstance(element, Element):
            raise TypeError(f"element must be Element, not {_type_name(element)}")
        return self.edit._made(lib.mxg_edit_copy_element, self.number, element.document._handle.pointer, element.number,
                               optional_text(name, "name"))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Draft) and other.edit is self.edit and other.number == self.number

    def __hash__(self) -> int:
        return hash((id(self.edit), self.number))

    def __repr__(self) -> str:
        return f"<Draft {self.number}>"


class Edit(Native):
    """A document under construction. `Context.edit` and `Document.edit` begin one; `end` makes the document.

    As a context manager it ends at the end of the block, and `document` is the document; an exception cancels the edit. An edit
    that fails raises EditError and changes nothing."""

    def __init__(self, context: Context, library: Library, source: Document | None, name: str) -> None:
        parents = (library._handle,) if source is None else (library._handle, source._handle)
        handle, _ = context._make(lib.mxg_edit_create, lib.mxg_edit_destroy, parents, library._handle.pointer,
                                  None if source is None else source._handle.pointer, c_text(name, "name"))
        self._handle = handle
        self._context = context
        self._library = library
        self._source = source
        self._document: Document | None = None
        self._numbers: dict[tuple[int, str], int] = {}  # by element and stem: a number up to which `unique_name` tries no name again

    # ---- Calls ----

    def _pointer(self) -> Any:
        return self._handle.pointer

    def _own(self, draft: Draft | Element) -> int:
        """The number of an element of the edit, or of the document that it comes from."""
        if isinstance(draft, Element):
            draft = self[draft]
        if not isinstance(draft, Draft):
            raise TypeError(f"an element of the edit must be Draft or Element, not {_type_name(draft)}")
        if draft.edit is not self:
            raise ValueError("the element is of another edit")
        return draft.number

    def _change(self, function: Any, *arguments: Any) -> None:
        pointer = self._pointer()
        with self._context._turn():
            status = function(pointer, *arguments)
            reason = _reason_of(pointer) if status == lib.MXG_ERROR_ARGUMENT else ""
        if status == lib.MXG_ERROR_ARGUMENT:
            raise EditError(reason or "the edit is impossible")
        if status != lib.MXG_OK:
            raise error_of(status)

    def _made(self, function: Any, *arguments: Any) -> Draft:
        pointer = self._pointer()
        with self._context._turn():
            number = function(pointer, *arguments)
            reason = "" if number else _reason_of(pointer)
        if not number:
            raise EditError(reason) if reason else error_of(lib.MXG_ERROR_MEMORY)
        return Draft(self, number)

    # ---- Elements ----

    @property
    def root(self) -> Draft:
        """<materialx>."""
        self._pointer()
        return Draft(self, 0)

    def find(self, path: str) -> Draft | None:
        """An element by path, as the edit is now."""
        number = lib.mxg_edit_find_element(self._pointer(), 0, c_text(path, "path"))
        return Draft(self, number) if number else None

    def __getitem__(self, path: str | Element) -> Draft:
        """An element by path, or an element of the document that the edit comes from, also after a new name. Raises KeyError."""
        if isinstance(path, Element):
            self._pointer()
            if path.document is not self._source:
                raise ValueError("the edit comes from another document")
            return Draft(self, path.number)
        found = self.find(path)
        if found is None:
            raise KeyError(path)
        return found

    def __contains__(self, path: object) -> bool:
        return isinstance(path, str) and self.find(path) is not None

    def unique_name(self, name: str) -> str:
        """A name that is new in the root: `Draft.unique_name`."""
        return self.root.unique_name(name)

    def add(self, category: str, name: str | None = None, type: str | None = None) -> Draft:
        """Appends an element to the root."""
        return self.root.add(category, name, type)

    def copy(self, element: Element, name: str | None = None) -> Draft:
        """Appends a copy of an element of any document to the root."""
        return self.root.copy(element, name)

    def group(self, nodes: Iterable[Draft | Element], name: str) -> Draft:
        """Moves nodes of the root into a new nodegraph, in this order. Sources outside that they read become its inputs, and
        results that others read its outputs."""
        numbers = [self._own(node) for node in nodes]
        return self._made(lib.mxg_edit_group_nodes, (ctypes.c_uint32 * len(numbers))(*numbers), len(numbers), c_text(name, "name"))

    def define(self, nodegraph: Draft | Element, name: str, node: str) -> Draft:
        """Makes the definition `name` of the kind of node `node` from a nodegraph of the root, which then implements it. Where
        elements read the nodegraph, a node of the definition takes its place."""
        return self._made(lib.mxg_edit_define_nodegraph, self._own(nodegraph), c_text(name, "name"), c_text(node, "node"))

    # ---- End ----

    def end(self) -> Document:
        """Makes the document. The edit is over, also after an error. Raises DocumentError."""
        pointer, handle = self._pointer(), self._handle
        out = ctypes.c_void_p()
        del self._handle
        made = None
        try:
            with self._context._turn():
                status = lib.mxg_edit_commit(pointer, out)
                if out.value:
                    made = Handle(out.value, lib.mxg_document_destroy, (self._context._handle, self._library._handle))
        except BaseException: # of a callback
            if made is not None:
                made.release()
            raise
        finally:
            handle.release()
        if made is None:
            raise error_of(status)
        document = Document(self._context, self._library, made)
        if status == lib.MXG_ERROR_DOCUMENT:
            raise document_error(document.diagnostics, document)
        if status != lib.MXG_OK:
            raise error_of(status)
        self._document = document
        return document

    def cancel(self) -> None:
        """Drops the edit."""
        self.close()

    @property
    def document(self) -> Document:
        """The document that the edit made."""
        if self._document is None:
            raise Error("the edit has not made a document")
        return self._document

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None) -> None:
        if kind is not None:
            self.cancel()
        elif self._is_open:
            self.end()


def _type_name(value: object) -> str:
    return type(value).__name__


def _numbers_of(value: Any) -> list[float]:
    """The numbers of a value in a row: of a matrix row by row."""
    if isinstance(value, Real):
        return [float(value)]
    if not isinstance(value, Iterable) or isinstance(value, (str, bytes, bytearray)):
        raise TypeError(f"value must be a number, str or a sequence of numbers, not {_type_name(value)}")
    return [number for item in value for number in _numbers_of(item)]


def _text_of(value: int | str) -> bytes:
    """A text, an integer or a boolean as MaterialX text."""
    if isinstance(value, str):
        return c_text(value, "value")
    if isinstance(value, bool):
        return b"true" if value else b"false"
    return str(value).encode()
