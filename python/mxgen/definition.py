# SPDX-License-Identifier: Apache-2.0
"""Libraries and the node definitions in them."""
from __future__ import annotations

import ctypes
import enum
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from typing import Any

from ._calls import Handle, Native, c_text, check_type, error_of, lib, py_text, record
from .diagnostic import Diagnostics


@dataclass(frozen=True, repr=False)
class UserInterface:
    """What a document says about an input for a user interface, in the words of its attributes."""

    uiname: str
    uifolder: str
    uimin: str
    uimax: str
    uisoftmin: str
    uisoftmax: str
    uistep: str
    doc: str
    #: the attribute enum
    enum_names: str
    enum_values: str
    #: uiadvanced
    advanced: bool

    def __repr__(self) -> str:
        """What is set, the texts for a user interface last."""
        last = len(fields(UserInterface))
        members = [(each.name, getattr(self, each.name)) for each in fields(self)[last:] + fields(self)[:last] if each.repr]
        shown = (f"{name}={value!r}" for name, value in members if value or isinstance(value, enum.Enum))
        return f"{type(self).__name__}({', '.join(shown)})"


@dataclass(frozen=True, repr=False)
class Port(UserInterface):
    """An input or output of a definition. A text that the definition does not have is ""."""

    name: str
    type: str
    #: the default of an input
    value: str
    defaultgeomprop: str
    unit: str
    uniform: bool
    unittype: str


@dataclass(frozen=True)
class Implementation:
    """What gives a definition its meaning: an <implementation>, or a nodegraph with a `nodedef`. A text that it does not have is ""."""

    name: str
    #: MaterialX's name: "genosl"; "": every target
    target: str
    nodegraph: str
    file: str
    function: str
    sourcecode: str


@dataclass(frozen=True)
class Readers:
    """The functions that read the definitions of a library, or those of a document."""

    nodedef: Callable[..., int]
    port: Callable[..., int]
    num_implementations: Callable[..., int]
    implementation: Callable[..., int]


_OF_LIBRARY = Readers(lib.mxg_library_nodedef, lib.mxg_library_port, lib.mxg_library_num_implementations, lib.mxg_library_implementation)
OF_DOCUMENT = Readers(lib.mxg_document_nodedef, lib.mxg_document_port, lib.mxg_document_num_implementations, lib.mxg_document_implementation)


@dataclass(frozen=True)
class NodeDef:
    """A node definition. A text that the definition does not have is ""."""

    name: str
    #: the category of its nodes
    node: str
    version: str
    group: str
    doc: str
    file: str
    num_inputs: int
    num_outputs: int
    #: for at least one target
    has_implementation: bool
    #: a node without a version uses this definition
    is_default_version: bool
    _owner: Native = field(repr=False, compare=False)
    _index: int = field(repr=False, compare=False)
    _readers: Readers = field(repr=False, compare=False)

    def _ports(self, first: int, count: int) -> tuple[Port, ...]:
        found = []
        for index in range(first, first + count):
            values = record("mxg_port", self._readers.port, self._owner._handle.pointer, self._index, index)
            assert values is not None
            found.append(Port(**values))
        return tuple(found)

    @property
    def inputs(self) -> tuple[Port, ...]:
        """The inputs, in the order of the definition."""
        return self._ports(0, self.num_inputs)

    @property
    def outputs(self) -> tuple[Port, ...]:
        """The outputs, in the order of the definition."""
        return self._ports(self.num_inputs, self.num_outputs)

    def input(self, name: str) -> Port | None:
        """An input by name."""
        return next((port for port in self.inputs if port.name == name), None)

    @property
    def implementations(self) -> tuple[Implementation, ...]:
        """The implementations; those of a document or of a library above the definition's come first."""
        pointer, found = self._owner._handle.pointer, []
        for index in range(self._readers.num_implementations(pointer, self._index)):
            values = record("mxg_implementation", self._readers.implementation, pointer, self._index, index)
            assert values is not None
            found.append(Implementation(**values))
        return tuple(found)


def read_nodedefs(owner: Native, count: int, readers: Readers) -> tuple[NodeDef, ...]:
    """The definitions of a library or document."""
    return tuple(read_nodedef(owner, index, readers) for index in range(count))


def read_nodedef(owner: Native, index: int, readers: Readers) -> NodeDef:
    """One definition of a library or document; the index is below their number."""
    values = record("mxg_nodedef", readers.nodedef, owner._handle.pointer, index)
    assert values is not None
    return NodeDef(**values, _owner=owner, _index=index, _readers=readers)


class Library(Native):
    """Node definitions; immutable. `Context.library` and `Context.load_library` give libraries."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    @property
    def diagnostics(self) -> Diagnostics:
        """The diagnostics of loading it."""
        return Diagnostics(lib.mxg_library_diagnostics(self._handle.pointer), self)

    @property
    def files(self) -> tuple[str, ...]:
        """Its files, and those of its bases. The built-in library has none."""
        pointer = self._handle.pointer
        return tuple(py_text(lib.mxg_library_file(pointer, index)) for index in range(lib.mxg_library_num_files(pointer)))

    @property
    def nodedefs(self) -> tuple[NodeDef, ...]:
        """Every definition, with those of the bases."""
        return read_nodedefs(self, lib.mxg_library_num_nodedefs(self._handle.pointer), _OF_LIBRARY)

    def nodedef(self, name: str) -> NodeDef | None:
        """The definition of a name: "ND_image_color3"."""
        c_text(name, "name")
        # A later definition replaces an earlier one.
        return next((nodedef for nodedef in reversed(self.nodedefs) if nodedef.name == name), None)

    def nodedefs_of(self, node: str) -> tuple[NodeDef, ...]:
        """The definitions of a node category: "image"."""
        c_text(node, "node")
        return tuple(nodedef for nodedef in self.nodedefs if nodedef.node == node)

    def supports(self, nodedef: NodeDef, target: str) -> bool:
        """Whether a definition of this library has an implementation for a target."""
        check_type(nodedef, NodeDef, "nodedef")
        if nodedef._owner is not self:
            raise ValueError(f"'{nodedef.name}' is not a definition of this library")
        return bool(lib.mxg_library_has_implementation(self._handle.pointer, nodedef._index, c_text(target, "target")))

    def _shown(self) -> str:
        return f"<Library: {lib.mxg_library_num_nodedefs(self._handle.pointer)} definitions>"

    def image(self) -> bytes:
        """The library image, for `Context.load_library(..., standalone=True)`. The library must be standalone."""
        data, size = ctypes.c_void_p(), ctypes.c_size_t()
        status = lib.mxg_library_image(self._handle.pointer, data, size)
        if status != lib.MXG_OK:
            raise error_of(status, "the library must be standalone" if status == lib.MXG_ERROR_ARGUMENT else "")
        return ctypes.string_at(data, size.value)

    def expand(self) -> str:
        """The library as a plain MaterialX document with all templates expanded."""
        text = lib.mxg_library_xml(self._handle.pointer, None)
        if not text:
            raise error_of(lib.MXG_ERROR_MEMORY)
        return py_text(text)

    @property
    def losses(self) -> Diagnostics:
        """What `expand` cannot say in graphs for other tools: a warning for each input."""
        losses = lib.mxg_library_losses(self._handle.pointer)
        if losses is None:
            raise error_of(lib.MXG_ERROR_MEMORY)
        return Diagnostics(losses, self)
