# SPDX-License-Identifier: Apache-2.0
"""Documents and their elements."""
from __future__ import annotations

import base64
import html
import os
import pathlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import TYPE_CHECKING, Any, NamedTuple, Union

from ._calls import Handle, Native, c_number, c_text, check_type, error_of, lib, new, py_text, record, sized_text
from .definition import OF_DOCUMENT, Library, NodeDef, read_nodedef, read_nodedefs
from .diagnostic import Diagnostics
from .error import ArgumentError, OutOfMemoryError, document_error
from .render import RenderError, render_picture
from .scene import Bindings, Scene, Stack, make_bind_desc
from .shader import OptionValue, Shader, View, make_options

if TYPE_CHECKING:
    from .context import Context
    from .edit import Edit

#: The value of an element: a tuple for a colour, vector or matrix; the text for other types and for arrays.
Value = Union[bool, int, float, str, tuple[float, ...]]


@dataclass(frozen=True)
class Rewritten:
    """A document as new text."""

    text: str
    #: the remarks `upgraded` describe each change of an upgrade, and the warnings of a translation what is lost
    diagnostics: Diagnostics


class _Holder(Native):
    """The owner of a result of which Python shows a part."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle


def rewritten(handle: Handle, status: int) -> Rewritten:
    """The text of a result. Raises DocumentError."""
    diagnostics = Diagnostics(lib.mxg_result_diagnostics(handle.pointer), _Holder(handle))
    if status != lib.MXG_OK:
        raise document_error(diagnostics)
    return Rewritten(py_text(lib.mxg_result_text(handle.pointer, None)), diagnostics)


@dataclass(frozen=True)
class Renderable:
    """An element that mxgen can generate."""

    #: "Gold", "NG_marble1/out"
    path: str
    #: "material", "surfaceshader", "color3" …
    type: str
    #: "surfacematerial", "output" …
    category: str


@dataclass(frozen=True)
class Connection:
    """The element that an input or output is connected to, as the document says it."""

    #: a node or nodegraph, or the input of the nodegraph; None: the document has no such element, or a definition declares the input
    source: Element | None
    #: the name of the output of `source`; "" if the document names none
    output: str
    #: "" if absent
    interfacename: str


class Edge(NamedTuple):
    """A connection of the graph."""

    #: the node or nodegraph that reads
    element: Element
    #: its input, or the <output> of the nodegraph
    input: Element
    #: the node or nodegraph that gives the value, or the input of the nodegraph
    upstream: Element


class Element:
    """An element of a document. Two are equal if they are the same element of the same document."""

    __slots__ = ("document", "number")

    def __init__(self, document: Document, number: int) -> None:
        check_type(document, Document, "document")
        self.document = document
        #: documents made by edits keep the number
        self.number = c_number(number, "number")
        self._info()

    def _info(self) -> dict[str, Any]:
        info = record("mxg_element_info", lib.mxg_document_element, self.document._handle.pointer, self.number)
        if info is None:
            raise ArgumentError(f"the document has no element {self.number}")
        return info

    def _element(self, number: int) -> Element | None:
        return Element(self.document, number) if number else None

    @property
    def category(self) -> str:
        """"nodegraph", "input", "standard_surface" …"""
        return str(self._info()["category"])

    @property
    def name(self) -> str:
        """The name; "" if it has none."""
        return str(self._info()["name"])

    @property
    def type(self) -> str:
        """The attribute `type`; "" if absent."""
        return str(self._info()["type"])

    @property
    def path(self) -> str:
        """"NG_marble1/out"; "" for the root."""
        pointer = self.document._handle.pointer
        return sized_text(lambda out, capacity: lib.mxg_document_element_path(pointer, self.number, out, capacity))

    @property
    def file(self) -> str | None:
        """The file of the element; None after an edit."""
        file: str | None = self._info()["file"]
        return file

    @property
    def line(self) -> int:
        """The line where it begins, from 1; 0 after an edit."""
        return int(self._info()["line"])

    @property
    def column(self) -> int:
        """The column where it begins, from 1; 0 after an edit."""
        return int(self._info()["column"])

    # ---- The tree ----

    @property
    def parent(self) -> Element | None:
        """The element around it; None for the root."""
        return self._element(self._info()["parent"])

    @property
    def children(self) -> tuple[Element, ...]:
        """The elements directly below."""
        found = []
        child = self._element(self._info()["first_child"])
        while child is not None:
            found.append(child)
            child = self._element(child._info()["next"])
        return tuple(found)

    def find(self, path: str) -> Element | None:
        """The element of a path below."""
        number = lib.mxg_document_find_element(self.document._handle.pointer, self.number, c_text(path, "path"))
        return self._element(number)

    def __getitem__(self, path: str) -> Element:
        """The element of a path below: shader["base_color"]. Raises KeyError."""
        element = self.find(path)
        if element is None:
            raise KeyError(path)
        return element

    def __contains__(self, path: object) -> bool:
        """Whether there is an element of a path below."""
        return isinstance(path, str) and self.find(path) is not None

    def __iter__(self) -> Iterator[Element]:
        """The elements directly below."""
        return iter(self.children)

    def child(self, name: str) -> Element | None:
        """The element of a name directly below."""
        path = c_text(name, "name")
        return self._element(lib.mxg_document_find_element(self.document._handle.pointer, self.number, path) if path else 0)

    def children_of(self, category: str) -> tuple[Element, ...]:
        """The elements of a category directly below."""
        check_type(category, str, "category")
        return tuple(child for child in self.children if child.category == category)

    def input(self, name: str) -> Element | None:
        """The input of a name; None: the document does not write it."""
        child = self.child(name)
        return child if child is not None and child.category == "input" else None

    def output(self, name: str) -> Element | None:
        """The output of a name."""
        child = self.child(name)
        return child if child is not None and child.category == "output" else None

    @property
    def inputs(self) -> tuple[Element, ...]:
        """The inputs that the document writes. `definition` has those that keep their defaults, too."""
        return self.children_of("input")

    @property
    def outputs(self) -> tuple[Element, ...]:
        """The outputs of a nodegraph."""
        return self.children_of("output")

    def walk(self) -> Iterator[Element]:
        """The element and all elements below, in the order of the document."""
        ahead = [self]
        while ahead:
            element = ahead.pop()
            yield element
            ahead.extend(reversed(list(element.children)))

    # ---- Attributes ----

    def get(self, attribute: str) -> str | None:
        """The text of an attribute ("name" included); None if it is absent."""
        key = c_text(attribute, "attribute")
        if attribute == "name":
            return self.name or None
        pointer = self.document._handle.pointer
        values = record("mxg_attribute", lib.mxg_document_attribute, pointer, self.number,
                        lib.mxg_document_find_attribute(pointer, self.number, key))
        return None if values is None else str(values["value"])

    @property
    def attributes(self) -> Mapping[str, str]:
        """The attributes without the name, in the order of the document."""
        found = {}
        for index in range(self._info()["num_attributes"]):
            values = record("mxg_attribute", lib.mxg_document_attribute, self.document._handle.pointer, self.number, index)
            assert values is not None
            found[values["name"]] = values["value"]
        return found

    @property
    def value(self) -> Value | None:
        """The value of an input, output or token by its type; the text if it is not a value of the type; None if it has none."""
        values = record("mxg_value", lib.mxg_document_value, self.document._handle.pointer, self.number)
        if values is None:
            return None
        numbers: tuple[float, ...] = values["values"][:values["num_values"]]
        if not numbers:
            return str(values["text"])
        if values["type"] == "boolean":
            return bool(numbers[0])
        if values["type"] == "integer":
            return int(values["integer"])
        return numbers[0] if len(numbers) == 1 else numbers

    # ---- The graph ----

    @property
    def connection(self) -> Connection | None:
        """The connection of an input or output; None if it has none."""
        out = new("mxg_connection")
        status = lib.mxg_document_connection(self.document._handle.pointer, self.number, out)
        if status == lib.MXG_ERROR_ARGUMENT:
            return None
        if status not in (lib.MXG_OK, lib.MXG_ERROR_DOCUMENT): # the latter: the source does not exist
            raise error_of(status)
        return Connection(self._element(out.source), py_text(out.output), py_text(out.interfacename))

    @property
    def edges(self) -> tuple[Edge, ...]:
        """The connections that the element depends on, each once, the nearest first. Goes into nodegraphs."""
        found: dict[Element, Edge] = {}
        ahead, seen = [self], {self}
        for element in ahead:
            for port in [element] if element.category in ("input", "output") else [*element.inputs, *element.outputs]:
                connection = port.connection
                if connection is None or connection.source is None:
                    continue
                found.setdefault(port, Edge(port.parent or element, port, connection.source))
                if connection.source not in seen:
                    seen.add(connection.source)
                    ahead.append(connection.source)
        return tuple(found.values())

    @property
    def upstream(self) -> tuple[Element, ...]:
        """The nodes and nodegraphs that the element depends on, each once, the nearest first. Goes into nodegraphs."""
        return tuple(dict.fromkeys(edge.upstream for edge in self.edges if edge.upstream.category != "input"))

    @property
    def definition(self) -> NodeDef | None:
        """The definition of a node, or of the nodegraph that implements it; None: there is none, or it does not fit. The
        diagnostics of `Document.validate` give the reason."""
        index = lib.mxg_document_find_nodedef(self.document._handle.pointer, self.number)
        if index == lib.MXG_NONE:
            return None
        return read_nodedef(self.document, index, OF_DOCUMENT)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Element) and other.document is self.document and other.number == self.number

    def __hash__(self) -> int:
        return hash((id(self.document), self.number))

    def __repr__(self) -> str:
        return f"<Element {self.category} '{self.path}'>" if self.document._is_open else "<Element: its document has ended>"


class Document(Native):
    """A document; immutable. `Context.load`, `Context.parse` and edits give documents."""

    def __init__(self, context: Context, library: Library, handle: Handle) -> None:
        self._handle = handle
        #: the context that made it
        self.context = context
        #: the library of its nodes
        self.library = library

    # ---- Contents ----

    @property
    def diagnostics(self) -> Diagnostics:
        """The diagnostics of reading it."""
        return Diagnostics(lib.mxg_document_diagnostics(self._handle.pointer), self)

    @property
    def files(self) -> tuple[str, ...]:
        """The files of the document, itself first."""
        pointer = self._handle.pointer
        return tuple(py_text(lib.mxg_document_file(pointer, index)) for index in range(lib.mxg_document_num_files(pointer)))

    @property
    def root(self) -> Element:
        """<materialx>. The tree is the one that generation sees: after includes, templates and the upgrade to 1.39."""
        return Element(self, lib.mxg_document_find_element(self._handle.pointer, 0, b""))

    def find(self, path: str) -> Element | None:
        """An element by path: "NG_marble1/out"."""
        number = lib.mxg_document_find_element(self._handle.pointer, 0, c_text(path, "path"))
        return Element(self, number) if number else None

    def __getitem__(self, path: str) -> Element:
        """An element by path. Raises KeyError."""
        element = self.find(path)
        if element is None:
            raise KeyError(path)
        return element

    def __iter__(self) -> Iterator[Element]:
        """The elements of the root."""
        return iter(self.root.children)

    def __len__(self) -> int:
        """The number of elements of the root."""
        return len(self.root.children)

    def __bool__(self) -> bool:
        """True, also for a document without elements."""
        return True

    def __contains__(self, item: object) -> bool:
        """Whether the document has an element, or one of a path."""
        return item.document is self if isinstance(item, Element) else isinstance(item, str) and self.find(item) is not None

    def _shown(self) -> str:
        return f"<Document '{self.files[0]}': {len(self)} elements>"

    def walk(self) -> Iterator[Element]:
        """All elements, in the order of the document, the root first."""
        return self.root.walk()

    @property
    def renderables(self) -> tuple[Renderable, ...]:
        """The materials. A document without materials has its graph outputs and the shaders that nothing uses."""
        found = []
        for index in range(lib.mxg_document_num_renderables(self._handle.pointer)):
            values = record("mxg_renderable", lib.mxg_document_renderable, self._handle.pointer, index)
            assert values is not None
            found.append(Renderable(**values))
        return tuple(found)

    def look_materials(self, look: str) -> tuple[Renderable, ...]:
        """The materials that a look or a look group assigns; empty if `look` is not the path of a look."""
        path = c_text(look, "look")
        return tuple(renderable for index, renderable in enumerate(self.renderables)
                     if lib.mxg_document_has_assignment(self._handle.pointer, path, index))

    @property
    def nodedefs(self) -> tuple[NodeDef, ...]:
        """The definitions of the library and of the document."""
        return read_nodedefs(self, lib.mxg_document_num_nodedefs(self._handle.pointer), OF_DOCUMENT)

    def xml(self) -> str:
        """The document as MaterialX XML. Reading the text gives an equal tree."""
        text = lib.mxg_document_xml(self._handle.pointer, None)
        if not text:
            raise OutOfMemoryError("there is no memory for the text")
        return py_text(text)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the document as MaterialX XML."""
        pathlib.Path(path).write_text(self.xml(), encoding="utf-8", errors="surrogateescape")

    def edit(self) -> Edit:
        """Begins a changed copy."""
        return self.context.edit(self)

    # ---- Notebooks ----

    def _repr_png_(self) -> bytes | None:
        """A picture of the first renderable, where mxgen-render is installed and can draw it."""
        try:
            return render_picture(self, size=256) if self.renderables else None
        except RenderError:
            return None

    def _repr_html_(self) -> str:
        """The picture and the messages."""
        image, messages = self._repr_png_(), str(self.validate())
        shown = "" if image is None else f'<img src="data:image/png;base64,{base64.b64encode(image).decode()}">'
        return f"{shown}<pre>{html.escape(messages or repr(self))}</pre>"

    # ---- Other models ----

    def translate(self, model: str, *, joined: bool = False) -> Rewritten:
        """The document with its surfaces as another shading model, "gltf_pbr" (docs/translate.md). The diagnostics tell what is lost.
        `joined`: a surface that is made of others, such as their <mix>, becomes one. Raises DocumentError."""
        handle, status = self.context._make(lib.mxg_translate_joined if joined else lib.mxg_translate, lib.mxg_result_destroy, (self._handle,), self._handle.pointer,
                                            c_text(model, "model"))
        return rewritten(handle, status)

    # ---- Scenes ----

    def with_materials(self, scene: Scene) -> Document:
        """A copy with the materials of a USD scene that the document lacks. Raises DocumentError."""
        check_type(scene, Scene, "scene")
        return self.context._document(self.library, lib.mxg_document_import, self._handle.pointer, scene._handle.pointer)

    def bind(self, scene: Scene, look: str | None = None, *, solo: Sequence[str] = (), mute: Sequence[str] = (),
             previous: Bindings | None = None) -> Bindings:
        """Finds the layers of each primitive of a scene. `look` is a look, or a look group with a default; None: the only look, or
        just the bindings of the scene if the document has none. `solo` has the slots that alone count, `mute` those that do not.
        `previous` are bindings of the scene before it or the document changed: the result is the same, and only primitives at or below a
        difference are resolved again. Raises DocumentError."""
        check_type(scene, Scene, "scene")
        handle, status = self.context._make(lib.mxg_bindings_create, lib.mxg_bindings_destroy, (self._handle, scene._handle),
                                            self._handle.pointer, scene._handle.pointer, make_bind_desc(look, solo, mute, previous))
        bindings = Bindings(self, scene, handle)
        if status != lib.MXG_OK:
            raise document_error(bindings.diagnostics)
        return bindings

    # ---- Calls ----

    def _context_for(self, context: Context | None) -> Context:
        used = self.context if context is None else context
        if not isinstance(used, type(self.context)):
            raise TypeError(f"context must be Context, not {type(used).__name__}")
        return used

    def _call(self, context: Context | None, function: Callable[..., int], *arguments: Any) -> tuple[Shader, int]:
        """Makes a result with this document, and with another context if one is given."""
        handle, status = self._context_for(context)._make(function, lib.mxg_result_destroy, (self._handle,),
                                                          self._handle.pointer, *arguments)
        return Shader(handle), status

    def validate(self, *, context: Context | None = None) -> Diagnostics:
        """Checks every node, connection and value against the library, without generating. Errors are in the result."""
        return self._call(context, lib.mxg_validate)[0].diagnostics

    def _request(self, context: Context | None, target: str, element: Item | None,
                 options: Mapping[str, OptionValue] | None) -> Any:
        """A mxg_generate_desc, which keeps its options."""
        desc = new("mxg_generate_desc")
        if isinstance(element, Stack):
            if element.bindings.document is not self:
                raise ValueError("the stack is of another document")
            desc.bindings = element.bindings._handle.pointer
            desc.stack = element.number
            element = None
        if isinstance(element, Element) and element.document is not self:
            raise ValueError("the element is of another document")
        if isinstance(element, (Element, Renderable)):
            element = element.path
        desc.target = c_text(target, "target")
        if element is not None:
            desc.element = c_text(element, "element")
        if options is not None:
            made_options = make_options(self._context_for(context), options)
            desc.keep = made_options
            desc.options = made_options._handle.pointer
        return desc

    def generate(self, target: str, element: Item | None = None, *, options: Mapping[str, OptionValue] | None = None,
                 without_source: bool = False, only_diagnostics: bool = False, context: Context | None = None) -> Shader:
        """Makes a shader. `element` is a material, shader, node or output, a graph with one output, a look with one material, or a
        stack of `Bindings`; None: the first renderable. `options` has the keys of `mxgen.options()`; a list gives several values. Raises
        DocumentError.

        `without_source` leaves out the source, `only_diagnostics` everything but the diagnostics. A thread that generates at the
        same time as another one gives its own `context`."""
        desc = self._request(context, target, element, options)
        desc.without_source = without_source
        desc.only_diagnostics = only_diagnostics
        shader, status = self._call(context, lib.mxg_generate, desc)
        if status != lib.MXG_OK:
            raise document_error(shader.diagnostics)
        return shader

    def inspect(self, view: View, element: Item | None = None, *, target: str = "glsl",
                options: Mapping[str, OptionValue] | None = None, context: Context | None = None) -> str:
        """A text for people: the tree, the graph, the IR or the closures. Raises DocumentError."""
        desc = self._request(context, target, element, options)
        result, status = self._call(context, lib.mxg_inspect, View(view), desc)
        if status != lib.MXG_OK:
            raise document_error(result.diagnostics)
        return result._text()


#: What `Document.generate` takes: a path, or the element itself.
Item = Union[str, Element, Renderable, Stack]


def equal(one: Document | Element, other: Document | Element) -> bool:
    """Whether two trees have the same elements in the same order, with the same attributes."""

    def contents(part: Document | Element) -> Iterator[tuple[object, ...]]:
        if not isinstance(part, (Document, Element)):
            raise TypeError(f"a tree must be Document or Element, not {type(part).__name__}")
        # The number of children at each element determines the shape of the tree.
        for element in part.walk():
            yield element.category, element.name, element.attributes, sum(1 for _ in element.children)

    return all(a == b for a, b in zip_longest(contents(one), contents(other)))
