# SPDX-License-Identifier: Apache-2.0
"""Scenes, and the layers of materials of their primitives (docs/slots.md)."""
from __future__ import annotations

import ctypes
import enum
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._calls import Handle, Native, c_number, c_text, c_texts, check_type, error_of, guarded, lib, new, optional_text, py_text, record, sized_text
from .diagnostic import Diagnostics
from .error import ArgumentError, document_error

if TYPE_CHECKING:
    from .document import Document

_NONE = 0xFFFFFFFF


# ---- Names of slots ----

def encode_slot(name: str) -> str:
    """The name of a slot in USD: "050::010" is "_050:_:_010". Raises ValueError."""
    return _slot_text(lib.mxg_slot_encode, name, "a name of a slot")


def decode_slot(identifiers: str) -> str:
    """The reverse of `encode_slot`. Raises ValueError."""
    return _slot_text(lib.mxg_slot_decode, identifiers, "an encoded name of a slot")


def _slot_text(function: Callable[..., int], text: str, what: str) -> str:
    data = c_text(text, "name")
    made = sized_text(lambda out, capacity: function(data, out, capacity))
    if not made:
        raise ValueError(f"'{text}' is not {what}")
    return made


# ---- Scenes ----

def _piece(struct: Any, name: str) -> str:
    """The text of a member without a NUL; member `<name>_len` has its length."""
    return py_text(ctypes.string_at(getattr(struct, name), getattr(struct, f"{name}_len")))


@dataclass(frozen=True)
class Property:
    """A property of USD. Its texts are those of the file."""

    name: str
    #: "point3f[]"; "rel" of a relationship
    type: str
    #: "faceVarying"; "" if the file does not say it
    interpolation: str
    #: "[(0, 0, 0), (1, 0, 0)]", of time samples the first; "" if it has none
    value: str
    file: str
    line: int
    column: int


class Primitive:
    """A primitive of a scene. Two are equal if they are the same primitive of the same scene."""

    __slots__ = ("scene", "number")

    def __init__(self, scene: Scene, number: int) -> None:
        check_type(scene, Scene, "scene")
        self.scene = scene
        #: a parent has a lower number than its children
        self.number = c_number(number, "number")
        self._info()

    def _info(self) -> Any:
        out = new("mxg_primitive")
        if lib.mxg_scene_primitive(self.scene._handle.pointer, self.number, out) != lib.MXG_OK:
            raise ArgumentError(f"the scene has no primitive {self.number}")
        return out

    @property
    def name(self) -> str:
        """The last part of the path."""
        return _piece(self._info(), "name")

    @property
    def type(self) -> str:
        """The type in USD: "Mesh"; "" if unknown."""
        return _piece(self._info(), "type")

    @property
    def path(self) -> str:
        """"/set/table"."""
        pointer = self.scene._handle.pointer
        return sized_text(lambda out, capacity: lib.mxg_scene_primitive_path(pointer, self.number, out, capacity))

    @property
    def parent(self) -> Primitive | None:
        """The primitive above; None for a root."""
        return self.scene._primitive(self._info().parent)

    @property
    def children(self) -> Iterator[Primitive]:
        """The primitives directly below."""
        child = self.scene._primitive(self._info().first_child)
        while child is not None:
            yield child
            child = self.scene._primitive(child._info().next_sibling)

    # ---- Properties ----

    @property
    def properties(self) -> Mapping[str, Property]:
        """The properties by name. A primitive of a list has none; an instance has those of its prototype that it does not set."""
        pointer = self.scene._handle.pointer
        found = {}
        out = new("mxg_property")
        for index in range(lib.mxg_scene_num_properties(pointer, self.number)):
            lib.mxg_scene_property(pointer, self.number, index, out)
            made = _read_property(out)
            found[made.name] = made
        return found

    def property(self, name: str) -> Property | None:
        """The property of a name; None: there is none."""
        out = new("mxg_property")
        pointer = self.scene._handle.pointer
        index = lib.mxg_scene_find_property(pointer, self.number, c_text(name, "name"))
        return _read_property(out) if lib.mxg_scene_property(pointer, self.number, index, out) == lib.MXG_OK else None

    def numbers(self, name: str) -> tuple[float, ...]:
        """The numbers of a property in a row; true is 1. Empty: there are none."""
        key = c_text(name, "name")
        pointer = self.scene._handle.pointer
        count = lib.mxg_scene_property_numbers(pointer, self.number, key, None, 0)
        out = (ctypes.c_double * count)()
        lib.mxg_scene_property_numbers(pointer, self.number, key, out, count)
        return tuple(out)

    def words(self, name: str) -> tuple[str, ...]:
        """The strings, tokens or paths of a property, without quotes."""
        key = c_text(name, "name")
        pointer = self.scene._handle.pointer
        found: list[str] = []
        while True:
            word = sized_text(lambda out, capacity: lib.mxg_scene_property_word(pointer, self.number, key, len(found), out, capacity))
            if not word:
                return tuple(found)
            found.append(word)

    def targets(self, name: str) -> tuple[Primitive | None, ...]:
        """The primitives that a relationship names; None for a path that the scene does not have."""
        key = c_text(name, "name")
        pointer = self.scene._handle.pointer
        count = lib.mxg_scene_property_targets(pointer, self.number, key, None, 0)
        out = (ctypes.c_uint32 * count)()
        lib.mxg_scene_property_targets(pointer, self.number, key, out, count)
        return tuple(self.scene._primitive(number) for number in out)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Primitive) and other.scene is self.scene and other.number == self.number

    def __hash__(self) -> int:
        return hash((id(self.scene), self.number))

    def __repr__(self) -> str:
        return f"<Primitive '{self.path}'>" if self.scene._is_open else "<Primitive: its scene has ended>"


def _read_property(struct: Any) -> Property:
    return Property(name=_piece(struct, "name"), type=_piece(struct, "type"), interpolation=_piece(struct, "interpolation"),
                    value=_piece(struct, "value"), file=py_text(struct.file), line=struct.line, column=struct.column)


@dataclass(frozen=True, eq=False)
class NewPrimitive:
    """A primitive for `Scene.add_each`."""

    #: a name, or a path below the parent: "b/c"
    name: str
    #: of the scene, or one that `Scene.add_each` was given before; None: there is none
    parent: Primitive | NewPrimitive | None = None
    #: as in USD: "Mesh"; "" if unknown
    type: str = ""


@dataclass(frozen=True)
class SlotBinding:
    """A binding of a scene itself."""

    #: the whole name: "050::010"
    slot: str
    #: the material or the nodegraph; "": a removal
    material: str
    #: it is for the members of a collection
    is_collection: bool
    #: it beats the bindings of the scene below it
    is_strong: bool
    #: it is for the purpose of `Context.load_scene`
    is_purpose: bool
    #: its place; "" if it comes from `Scene.bind`
    file: str
    line: int


class _Adding:
    """The primitives that C asks for, one after the other. An exception waits until the call returns."""

    def __init__(self, scene: Scene, primitives: Iterable[NewPrimitive]) -> None:
        self.scene = scene
        self.items = iter(primitives)
        self.given: list[NewPrimitive] = []
        self.numbers: list[int] = []
        self.known: dict[NewPrimitive, int] = {}
        self.raised: BaseException | None = None
        self.keep: tuple[Any, ...] = () # the texts of the last one

    def parent(self, item: NewPrimitive) -> int:
        above = item.parent
        if above is None:
            return _NONE
        if isinstance(above, NewPrimitive):
            if above not in self.known:
                raise ValueError(f"the parent of '{item.name}' was not given before")
            return self.known[above]
        if not isinstance(above, Primitive):
            raise TypeError(f"parent must be Primitive, NewPrimitive or None, not {type(above).__name__}")
        if above.scene is not self.scene:
            raise ValueError("the parent is of another scene")
        return above.number

    def fill(self, last: int, out: Any) -> bool:
        """Takes the number of the primitive before, and gives the next."""
        if self.given:
            self.numbers.append(last)
            self.known[self.given[-1]] = last
        for item in self.items:
            if not isinstance(item, NewPrimitive):
                raise TypeError(f"a primitive must be NewPrimitive, not {type(item).__name__}")
            self.given.append(item)
            self.keep = ctypes.create_string_buffer(c_text(item.name, "name")), ctypes.create_string_buffer(c_text(item.type, "type"))
            out.contents.parent = self.parent(item)
            for name, text in zip(("name", "type"), self.keep):
                setattr(out.contents, name, ctypes.addressof(text))
                setattr(out.contents, f"{name}_len", len(text) - 1)
            return True
        return False


class Scene(Native):
    """The primitives of a scene. `Context.scene` and `Context.load_scene` give scenes."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    def _primitive(self, number: int) -> Primitive | None:
        return Primitive(self, number) if number != _NONE else None

    @property
    def diagnostics(self) -> Diagnostics:
        """The diagnostics of reading it."""
        return Diagnostics(lib.mxg_scene_diagnostics(self._handle.pointer), self)

    def add(self, *paths: str) -> None:
        """Adds primitives and those above them. Raises DocumentError if a path is none (the others are added). After any change of a
        scene its bindings say nothing any more: call `Document.bind` with `previous`."""
        names = c_texts(c_text(path, "a path") for path in paths)
        status = lib.mxg_scene_add_paths(self._handle.pointer, names, len(paths))
        if status == lib.MXG_ERROR_DOCUMENT:
            raise document_error(self.diagnostics)
        if status != lib.MXG_OK:
            raise error_of(status)

    def add_each(self, primitives: Iterable[NewPrimitive]) -> tuple[Primitive | None, ...]:
        """Adds primitives with parents and types, and gives them: None for one that is faulty. Raises DocumentError if all are added but
        faulty ones. The iterable must not use the scene."""
        adding = _Adding(self, primitives)
        status = lib.mxg_scene_add_primitives(self._handle.pointer, guarded("next_primitive", adding, adding.fill, False), None)
        if adding.raised is not None:
            raise adding.raised
        if status == lib.MXG_ERROR_DOCUMENT:
            raise document_error(self.diagnostics)
        if status != lib.MXG_OK:
            raise error_of(status)
        return tuple(self._primitive(number) for number in adding.numbers)

    def remove(self, *primitives: Primitive | str) -> None:
        """Removes primitives, all below them, and their bindings. The numbers of the others stay. Raises ArgumentError if one is removed
        already, and KeyError for an unknown path: all stay then."""
        numbers = [self._place(primitive) for primitive in primitives]
        self._change(lib.mxg_scene_remove_primitives(self._handle.pointer, (ctypes.c_uint32 * len(numbers))(*numbers), len(numbers)))

    # ---- Bindings of the scene itself ----

    def _place(self, primitive: Primitive | str | None) -> int:
        if primitive is None:
            return _NONE
        found = self[primitive] if isinstance(primitive, str) else primitive
        if not isinstance(found, Primitive):
            raise TypeError(f"primitive must be Primitive, str or None, not {type(found).__name__}")
        if found.scene is not self:
            raise ValueError("the primitive is of another scene")
        return found.number

    def _change(self, status: int) -> None:
        if status == lib.MXG_ERROR_DOCUMENT:
            raise document_error(self.diagnostics)
        if status != lib.MXG_OK:
            raise error_of(status)

    def bind(self, primitive: Primitive | str | None, slot: str, material: str) -> None:
        """Binds a material to a slot of a primitive (None: the whole scene), in the place of its direct bindings there. "" removes what
        the primitive would inherit. Raises DocumentError if the slot's name is none."""
        self._change(lib.mxg_scene_set_binding(self._handle.pointer, self._place(primitive), c_text(slot, "slot"), c_text(material, "material")))

    def unbind(self, primitive: Primitive | str | None, slot: str) -> None:
        """Removes the direct bindings of a slot from a primitive."""
        self._change(lib.mxg_scene_remove_binding(self._handle.pointer, self._place(primitive), c_text(slot, "slot")))

    def bindings_of(self, primitive: Primitive | str | None) -> tuple[SlotBinding, ...]:
        """The bindings of the scene itself that stand at a primitive; None: the whole scene."""
        number = self._place(primitive)
        pointer = self._handle.pointer
        found = []
        for index in range(lib.mxg_scene_num_bindings(pointer, number)):
            values = record("mxg_slot_binding", lib.mxg_scene_binding, pointer, number, index)
            assert values is not None
            found.append(SlotBinding(**values))
        return tuple(found)

    def find(self, path: str) -> Primitive | None:
        """A primitive by path."""
        return self._primitive(lib.mxg_scene_find_primitive(self._handle.pointer, c_text(path, "path")))

    def __getitem__(self, path: str) -> Primitive:
        """A primitive by path. Raises KeyError."""
        primitive = self.find(path)
        if primitive is None:
            raise KeyError(path)
        return primitive

    def __len__(self) -> int:
        """The number of primitives."""
        return sum(1 for _ in self)

    def __iter__(self) -> Iterator[Primitive]:
        """All primitives, each after its parent."""
        pointer = self._handle.pointer
        out = new("mxg_primitive")
        return (Primitive(self, number) for number in range(lib.mxg_scene_num_primitives(pointer))
                if lib.mxg_scene_primitive(pointer, number, out) == lib.MXG_OK)

    def _shown(self) -> str:
        return f"<Scene: {len(self)} primitives>"

    @property
    def up_axis(self) -> str:
        """"Y" or "Z"."""
        axis: bytes = lib.mxg_scene_up_axis(self._handle.pointer)
        return axis.decode("ascii")

    @property
    def meters_per_unit(self) -> float:
        """Metres in a unit of the scene; 0 for a list of paths."""
        return float(lib.mxg_scene_meters_per_unit(self._handle.pointer))


# ---- Bindings ----

class LayerKind(enum.IntEnum):
    """The kind of a layer."""

    #: a slot; the base comes first
    LAYER = lib.MXG_LAYER
    #: a product that the layer before takes from a weaker assignment
    PRODUCT = lib.MXG_LAYER_PRODUCT
    #: of the layer before; a later one wins
    OVERRIDE = lib.MXG_LAYER_OVERRIDE
    #: over the LAYER before
    VERTICAL = lib.MXG_LAYER_VERTICAL
    #: beside the stack
    VOLUME = lib.MXG_LAYER_VOLUME
    LIGHT = lib.MXG_LAYER_LIGHT


@dataclass(frozen=True)
class Layer:
    """A layer of a primitive."""

    kind: LayerKind
    #: the whole name: "050::010"
    slot: str
    #: the material, or the nodegraph if `is_nodegraph`
    material: str
    is_nodegraph: bool
    #: of PRODUCT: "mask"; otherwise ""
    product: str
    #: the primitive where the assignment stands; None: the whole scene, "/"
    source: Primitive | None
    #: the look and the name of the assignment ("" if it has none), or the property of the scene
    look: str
    assign: str
    #: the place of the assignment
    file: str
    line: int


class FactKind(enum.IntEnum):
    """What a fact of a primitive is."""

    #: a geometric property, of a <geominfo>
    GEOMPROP = lib.MXG_FACT_GEOMPROP
    #: a token for file names, of a <geominfo>
    TOKEN = lib.MXG_FACT_TOKEN
    #: of a <propertyassign> or a <propertysetassign>
    PROPERTY = lib.MXG_FACT_PROPERTY
    #: the name is the vistype, "" for all; the value "true" or "false"
    VISIBILITY = lib.MXG_FACT_VISIBILITY


@dataclass(frozen=True)
class Fact:
    """What the document says of a primitive beside its layers."""

    kind: FactKind
    #: name, type and value as in the document
    name: str
    type: str
    value: str
    #: the renderer that a property is for; the geometry that sees a visibility; "": all
    target: str
    #: the primitive where it stands; None: the whole scene, "/"
    source: Primitive | None
    #: the place of the element
    file: str
    line: int


class BindingsFormat(enum.IntEnum):
    """A form of `Bindings.text`."""

    #: a line for each primitive
    TABLE = lib.MXG_BINDINGS_TABLE
    TABLE_COLOUR = lib.MXG_BINDINGS_TABLE_COLOUR
    JSON = lib.MXG_BINDINGS_JSON
    #: slot bindings of USD
    USDA = lib.MXG_BINDINGS_USDA


class _Pieces:
    """What a call of C writes. An exception waits until the call returns."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.raised: BaseException | None = None

    def add(self, data: int, size: int) -> bool:
        self.data += ctypes.string_at(data, size)
        return True


def _written(function: Callable[..., int], *arguments: Any) -> tuple[str, int]:
    """The text that a function writes in pieces, and its status."""
    pieces = _Pieces()
    status = function(*arguments, guarded("write", pieces, pieces.add, False), None)
    if pieces.raised is not None:
        raise pieces.raised
    return pieces.data.decode("utf-8", "surrogateescape"), status


@dataclass(frozen=True)
class Stack:
    """The layers that several primitives share. `Document.generate` makes its shader."""

    bindings: Bindings
    #: from 0
    number: int
    #: follows from the content: "stack_8a5f7a0f9c2f6f0e"
    name: str


class Bindings(Native):
    """The layers of each primitive of a scene under a look. `Document.bind` gives bindings."""

    def __init__(self, document: Document, scene: Scene, handle: Handle) -> None:
        self._handle = handle
        self.document = document
        self.scene = scene

    def _number(self, primitive: Primitive | str) -> int:
        found = self.scene[primitive] if isinstance(primitive, str) else primitive
        if not isinstance(found, Primitive):
            raise TypeError(f"primitive must be Primitive or str, not {type(found).__name__}")
        if found.scene is not self.scene:
            raise ValueError("the primitive is of another scene")
        return found.number

    @property
    def diagnostics(self) -> Diagnostics:
        """The diagnostics of finding the layers."""
        return Diagnostics(lib.mxg_bindings_diagnostics(self._handle.pointer), self)

    def _shown(self) -> str:
        return f"<Bindings: {lib.mxg_bindings_num_stacks(self._handle.pointer)} stacks>"

    @property
    def num_resolved(self) -> int:
        """The number of primitives whose assignments were found: all, or with `previous` those at or below a difference."""
        return int(lib.mxg_bindings_num_resolved_primitives(self._handle.pointer))

    def _records(self, struct: str, count: Any, get: Any, primitive: Primitive | str) -> Iterator[dict[str, Any]]:
        """The members of each struct of a primitive; `source` is the primitive that it comes from."""
        number, pointer = self._number(primitive), self._handle.pointer
        for index in range(count(pointer, number)):
            values = record(struct, get, pointer, number, index)
            assert values is not None
            values["source"] = self.scene._primitive(values.pop("from"))
            yield values

    def layers(self, primitive: Primitive | str) -> tuple[Layer, ...]:
        """The layers of a primitive, base first; a product, override or vertical layer follows its layer."""
        found = self._records("mxg_layer", lib.mxg_bindings_num_layers, lib.mxg_bindings_layer, primitive)
        return tuple(Layer(kind=LayerKind(values.pop("kind")), **values) for values in found)

    def facts(self, primitive: Primitive | str) -> tuple[Fact, ...]:
        """Properties, tokens and visibility of a primitive: the strongest of each kind, name and target."""
        found = self._records("mxg_fact", lib.mxg_bindings_num_facts, lib.mxg_bindings_fact, primitive)
        return tuple(Fact(kind=FactKind(values.pop("kind")), **values) for values in found)

    @property
    def stacks(self) -> tuple[Stack, ...]:
        """The different stacks of the scene."""
        return tuple(self._stack(number) for number in range(lib.mxg_bindings_num_stacks(self._handle.pointer)))

    def stack(self, primitive: Primitive | str) -> Stack | None:
        """The stack of a primitive. Primitives with equal layers have the same one."""
        number = lib.mxg_bindings_stack(self._handle.pointer, self._number(primitive))
        return self._stack(number) if number != _NONE else None

    def _stack(self, number: int) -> Stack:
        pointer = self._handle.pointer
        return Stack(self, number, sized_text(lambda out, size: lib.mxg_bindings_stack_name(pointer, number, out, size)))

    def text(self, format: BindingsFormat = BindingsFormat.TABLE) -> str:
        """All bindings as text. Raises DocumentError if USDA cannot express some of them."""
        made, status = _written(lib.mxg_bindings_write, self._handle.pointer, BindingsFormat(format))
        if status == lib.MXG_ERROR_DOCUMENT:
            raise document_error(self.diagnostics)
        if status != lib.MXG_OK:
            raise error_of(status)
        return made

    def explain(self, primitive: Primitive | str) -> str:
        """The reasons of a primitive's layers: every assignment that was considered."""
        made, status = _written(lib.mxg_bindings_write_reasons, self._handle.pointer, self._number(primitive))
        if status != lib.MXG_OK:
            raise error_of(status)
        return made


def make_bind_desc(look: str | None, solo: Sequence[str], mute: Sequence[str], previous: Bindings | None) -> Any:
    """A mxg_bindings_desc."""
    desc = new("mxg_bindings_desc", look=optional_text(look, "look"))
    if previous is not None:
        check_type(previous, Bindings, "previous")
        desc.previous = previous._handle.pointer
    for name, slots in ("solo", solo), ("mute", mute):
        if isinstance(slots, str):
            raise TypeError(f"{name} must be a sequence of names, not str")
        setattr(desc, name, c_texts(c_text(slot, f"a name of {name}") for slot in slots))
        setattr(desc, f"num_{name}", len(slots))
    return desc
