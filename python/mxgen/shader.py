# SPDX-License-Identifier: Apache-2.0
"""Shaders: sources and reflection."""
from __future__ import annotations

import ctypes
import enum
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from typing import TYPE_CHECKING, Any, NamedTuple, Union

from ._calls import Handle, Native, c_number, c_text, check_type, error_of, lib, py_text, record, sized_text
from .definition import UserInterface
from .diagnostic import Diagnostics
from .error import ArgumentError, OutOfMemoryError

if TYPE_CHECKING:
    from .context import Context
    from .document import Document

#: The value of an option of generation; a sequence gives several values of a list.
OptionValue = Union[bool, int, float, str, Sequence[str]]


class Stage(enum.IntEnum):
    """A stage of a shader."""

    VERTEX = lib.MXG_STAGE_VERTEX
    PIXEL = lib.MXG_STAGE_PIXEL


class Block(enum.IntEnum):
    """The block of a variable."""

    PUBLIC_UNIFORMS = lib.MXG_BLOCK_PUBLIC_UNIFORMS
    PRIVATE_UNIFORMS = lib.MXG_BLOCK_PRIVATE_UNIFORMS
    LIGHT_DATA = lib.MXG_BLOCK_LIGHT_DATA
    TEXTURES = lib.MXG_BLOCK_TEXTURES
    APP_DATA = lib.MXG_BLOCK_APP_DATA
    VERTEX_DATA = lib.MXG_BLOCK_VERTEX_DATA
    OUTPUTS = lib.MXG_BLOCK_OUTPUTS
    #: the blocks that nodes in C declare, in this order
    OWN_1 = lib.MXG_BLOCK_OWN_1
    OWN_2 = lib.MXG_BLOCK_OWN_2
    OWN_3 = lib.MXG_BLOCK_OWN_3
    OWN_4 = lib.MXG_BLOCK_OWN_4


class Alpha(enum.IntEnum):
    """How a host draws a shader."""

    #: without blending
    OPAQUE = lib.MXG_ALPHA_OPAQUE
    #: with the depth test alone; the shader discards pixels below u_alphaThreshold
    MASK = lib.MXG_ALPHA_MASK
    #: back to front, blended over the pixels behind; colours are premultiplied
    BLEND = lib.MXG_ALPHA_BLEND


class View(enum.IntEnum):
    """What `Document.inspect` shows."""

    ELEMENTS = lib.MXG_VIEW_ELEMENTS
    GRAPH = lib.MXG_VIEW_GRAPH
    #: for Graphviz
    DOT = lib.MXG_VIEW_DOT
    IR = lib.MXG_VIEW_IR
    CLOSURES = lib.MXG_VIEW_CLOSURES
    STATISTICS = lib.MXG_VIEW_STATISTICS
    SLABS = lib.MXG_VIEW_SLABS
    SLABS_JSON = lib.MXG_VIEW_SLABS_JSON


@dataclass(frozen=True)
class Tile:
    """A tile of a texture: texture coordinates from (u, v) to (u + 1, v + 1)."""

    file: str
    u: int
    v: int


@dataclass(frozen=True, repr=False)
class Variable(UserInterface):
    """A uniform, attribute, texture or output of a shader (docs/reflection.md)."""

    #: as in the source; a member does not include the name of its block
    name: str
    block: Block
    #: bit s: stage s reads the variable
    stages: int
    #: a type of the shading language
    type: str
    #: "color3"; "" for private variables
    document_type: str
    #: "SR_gold/base_color"; "" for private variables
    path: str
    #: "worldMatrix", "geomprop:st"; "" for public variables
    semantic: str
    colorspace: str
    unit: str
    #: 0: not an array
    array_length: int
    set: int
    binding: int
    location: int
    #: in a block
    offset: int
    byte_size: int
    array_stride: int
    matrix_stride: int
    num_values: int
    #: components of the default; integers and booleans as numbers
    values: tuple[float, ...]
    file: str
    uaddressmode: str
    vaddressmode: str
    filtertype: str
    #: the name of the file's layer
    layer: str
    #: the frames of a sequence
    framerange: str
    frameendaction: str
    frameoffset: int
    num_tiles: int
    unittype: str
    #: not interpolated between vertices
    flat: bool
    #: the exact default of an integer
    integer: int
    #: of a stack: the slot that the input belongs to
    slot: str
    #: of the sampler beside a texture; equal to `binding` where both have one
    sampler_binding: int
    #: textures: the document, the include or the library that names `file`, which is relative to the folder of this one
    origin: str
    _shader: Shader = field(repr=False, compare=False)
    _index: int = field(repr=False, compare=False)

    @property
    def tiles(self) -> tuple[Tile, ...]:
        """The tiles of an image; tile n is layer n of the texture array."""
        found = []
        for tile in range(self.num_tiles):
            values = record("mxg_tile", lib.mxg_result_tile, self._shader._handle.pointer, self._index, tile)
            assert values is not None
            found.append(Tile(**values))
        return tuple(found)

    def texture_file(self, frame: int = 0, tile: int = 0) -> str | None:
        """The file of a texture, or of one of its tiles, at a frame; None: the host shows the default colour."""
        pointer, place = self._shader._handle.pointer, c_number(tile, "tile")
        at = c_number(frame, "frame", signed=True)
        text = sized_text(lambda out, capacity: lib.mxg_result_texture_file(pointer, self._index, place, at, out, capacity))
        return text or None


@dataclass(frozen=True, repr=False)
class CompiledInput(UserInterface):
    """An input whose value is compiled in. A new value needs a new generation."""

    path: str
    type: str
    #: as written: "0.5", "oren_nayar"; "" for zero
    value: str
    #: the document has the value; otherwise it is the default
    authored: bool


class InputState(enum.IntEnum):
    """The effect of a new value of an input on a shader."""

    #: the document has no input of this path
    UNKNOWN = lib.MXG_INPUT_UNKNOWN
    #: the shader does not need the input
    UNUSED = lib.MXG_INPUT_UNUSED
    #: a variable has the value: `Shader.find_variable`
    UNIFORM = lib.MXG_INPUT_UNIFORM
    #: needs a new generation: `Shader.compiled_inputs`
    COMPILED = lib.MXG_INPUT_COMPILED
    #: no value: the input is connected, or its default is a property of the geometry
    CONNECTED = lib.MXG_INPUT_CONNECTED


class Change(enum.IntEnum):
    """What a host changes to draw another shader."""

    NOTHING = lib.MXG_CHANGE_NOTHING
    #: the program stays; some variables have other values
    VALUES = lib.MXG_CHANGE_VALUES
    #: another program
    SHADER = lib.MXG_CHANGE_SHADER


@dataclass(frozen=True)
class Semantic:
    """The meaning of a variable without a path (docs/reflection.md)."""

    block: Block
    semantic: str
    #: "": several
    type: str
    doc: str


@dataclass(frozen=True)
class BlockInfo:
    """A block of the interface. Its variables have consecutive indices."""

    name: str
    first_variable: int
    num_variables: int
    #: for uniforms in a buffer; 0: single uniforms
    byte_size: int
    set: int
    binding: int
    #: LightData: the lights, and their distance in bytes
    array_length: int
    array_stride: int


@dataclass(frozen=True)
class LightType:
    """A light shader: u_lightData[i].type selects it for light i."""

    type: int
    name: str
    #: made of nodes: also reads the members `position` and `direction`
    is_shader: bool
    #: the members of LightData that it reads as its inputs; None: no stage reads the member
    members: tuple[Variable | None, ...]


@dataclass(frozen=True)
class Part:
    """A layer of an OSL network: the file "<name>.osl"."""

    name: str
    source: str
    #: "" for the last shader of a group
    nodedef: str


class Place(NamedTuple):
    """The place in the document that produced a line of a source."""

    file: str | None
    line: int
    column: int
    path: str


@dataclass(frozen=True)
class ShaderInfo:
    """A shader as a whole."""

    name: str
    path: str
    target: str
    #: a hash: equal for shaders that differ only in names and uniform values
    topology: int
    num_closures: int
    num_textures: int
    num_lights: int
    transparent: bool
    lit: bool
    #: the vertex stage moves the surface
    displaced: bool
    alpha: Alpha
    #: with role=function, the names of the function and of the struct that it returns; with role=scatter
    #: the name of the function alone; else ""
    function: str
    function_type: str
    #: features that the device must have, with commas between: in WGSL "shader-f16" with precision=mediump, "dual-source-blending" with
    #: transparency=dual
    device_features: str

@dataclass(frozen=True)
class Storage:
    """What a shader stores for the passes of the deferred pipeline, or what a pass reads."""

    #: of 32 bits per pixel, at most, or of the payload; 0: the shader lights itself
    words: int
    #: of the words: equal in all materials and passes that fit together
    layout: int
    #: classes of pixels, as bits, that a material may store or a lighting pass lights
    classes: int


@dataclass(frozen=True)
class PassInfo:
    """How a pass of the deferred pipeline runs."""

    name: str
    #: invocations of a group, which covers a tile of as many pixels
    group_size: tuple[int, int, int]
    #: the buffer "tiles" has the command of its dispatch; else a group per tile
    is_indirect: bool
    #: of that command, in bytes
    dispatch_offset: int
    #: bits of resources, by their place in `pass_resources()`
    reads: int
    writes: int


class Shader(Native):
    """A generated shader; immutable. `Document.generate` gives shaders."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    def _shown(self) -> str:
        values = record("mxg_shader_info", lib.mxg_result_info, self._handle.pointer)
        return f"<Shader '{values['name']}' for {values['target']}>" if values else "<Shader: diagnostics only>"

    # ---- Source ----

    def source(self, stage: Stage) -> str | None:
        """The source of a stage; None if the shader has no such stage."""
        text = lib.mxg_result_source(self._handle.pointer, Stage(stage), None)
        return py_text(text) if text else None

    @property
    def vertex(self) -> str | None:
        """The source of the vertex stage (OSL: of displacement)."""
        return self.source(Stage.VERTEX)

    @property
    def pixel(self) -> str | None:
        """The source of the pixel stage (OSL: of the shader)."""
        return self.source(Stage.PIXEL)

    @property
    def parts(self) -> tuple[Part, ...]:
        """With the option `osl-network`: the shaders of the layers."""
        found = []
        for index in range(lib.mxg_result_num_parts(self._handle.pointer)):
            values = record("mxg_part", lib.mxg_result_part, self._handle.pointer, index)
            assert values is not None
            del values["source_size"]
            found.append(Part(**values))
        return tuple(found)

    @property
    def host_functions(self) -> tuple[str, ...]:
        """The functions that the pixel stage calls and the host writes (docs/hosts.md)."""
        pointer = self._handle.pointer
        names = [lib.mxg_result_host_function(pointer, index) for index in range(lib.mxg_result_num_host_functions(pointer))]
        return tuple(py_text(name) for name in names)

    def source_place(self, stage: Stage, line: int) -> Place | None:
        """The place in the document that produced a line (from 1)."""
        values = record("mxg_place", lib.mxg_result_source_place, self._handle.pointer, Stage(stage), c_number(line, "line"))
        return None if values is None else Place(**values)

    def source_path(self, stage: Stage, line: int) -> str | None:
        """The path of the node that produced a line, also of a node inside a definition: "SR_gold/coat_bsdf"."""
        pointer, place = self._handle.pointer, Stage(stage)
        c_number(line, "line")
        return sized_text(lambda out, capacity: lib.mxg_result_source_path(pointer, place, line, out, capacity)) or None

    @property
    def closure_paths(self) -> tuple[str, ...]:
        """The paths of the nodes that produced the closures."""
        pointer = self._handle.pointer

        def path(index: int) -> str:
            return sized_text(lambda out, capacity: lib.mxg_result_closure_path(pointer, index, out, capacity))

        return tuple(path(index) for index in range(self.info.num_closures))

    @property
    def files(self) -> tuple[str, ...]:
        """Files beside those of the document that the shader depends on: photometric profiles."""
        pointer = self._handle.pointer
        return tuple(py_text(lib.mxg_result_file(pointer, index)) for index in range(lib.mxg_result_num_files(pointer)))

    @property
    def diagnostics(self) -> Diagnostics:
        """The diagnostics of the call: warnings, if it succeeded."""
        return Diagnostics(lib.mxg_result_diagnostics(self._handle.pointer), self)

    # ---- Reflection ----

    @property
    def info(self) -> ShaderInfo:
        """The shader as a whole. Raises ArgumentError with `only_diagnostics`."""
        values = record("mxg_shader_info", lib.mxg_result_info, self._handle.pointer)
        if values is None:
            raise ArgumentError("the call made diagnostics only")
        values["alpha"] = Alpha(values["alpha"])
        return ShaderInfo(**values)

    @property
    def storage(self) -> Storage:
        """What the shader stores for the passes of the deferred pipeline. Raises ArgumentError with `only_diagnostics`."""
        values = record("mxg_storage", lib.mxg_result_storage, self._handle.pointer)
        if values is None:
            raise ArgumentError("the call made diagnostics only")
        return Storage(**values)

    @property
    def pass_info(self) -> PassInfo | None:
        """How the pass runs; None for a shader that is none."""
        values = record("mxg_pass", lib.mxg_result_pass, self._handle.pointer)
        return None if values is None else PassInfo(**values)

    def _variable(self, index: int) -> Variable:
        values = record("mxg_variable", lib.mxg_result_variable, self._handle.pointer, index)
        assert values is not None
        values["block"] = Block(values["block"])
        values["values"] = values["values"][:values["num_values"]]
        return Variable(**values, _shader=self, _index=index)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """Every variable of the interface."""
        return tuple(self._variable(index) for index in range(lib.mxg_result_num_variables(self._handle.pointer)))

    def find_variable(self, path: str) -> Variable | None:
        """The variable for a document path; None: the input is unused or compiled in."""
        index = lib.mxg_result_find_variable(self._handle.pointer, c_text(path, "path"))
        return None if index == lib.MXG_NONE else self._variable(index)

    @property
    def compiled_inputs(self) -> tuple[CompiledInput, ...]:
        """Inputs whose value is compiled in."""
        found = []
        for index in range(lib.mxg_result_num_compiled_inputs(self._handle.pointer)):
            values = record("mxg_compiled_input", lib.mxg_result_compiled_input, self._handle.pointer, index)
            assert values is not None
            found.append(CompiledInput(**values))
        return tuple(found)

    def input_state(self, path: str) -> InputState:
        """The effect of a new value of an input of a node or nodegraph."""
        return InputState(lib.mxg_result_input_state(self._handle.pointer, c_text(path, "path")))

    def change(self, after: Shader) -> tuple[Change, tuple[Variable, ...]]:
        """What a host changes to draw `after` in place of this shader, and the variables of `after` with other values."""
        check_type(after, Shader, "after")
        capacity = lib.mxg_result_num_variables(after._handle.pointer)
        indices, count = (ctypes.c_uint32 * capacity)(), ctypes.c_uint32()
        change = Change(lib.mxg_result_change(self._handle.pointer, after._handle.pointer, indices, capacity, count))
        return change, tuple(after._variable(indices[i]) for i in range(min(count.value, capacity)))

    def block(self, block: Block) -> BlockInfo:
        """A block of the interface."""
        values = record("mxg_block_info", lib.mxg_result_block, self._handle.pointer, Block(block))
        if values is None:
            raise ArgumentError("the call made no interface")
        return BlockInfo(**values)

    def pack(self, block: Block) -> bytearray:
        """The buffer of a block of uniforms with the default values, ready for upload."""
        data, status = self._packed(None, block)
        assert status == lib.MXG_OK
        return data

    def _packed(self, document: Any, block: Block) -> tuple[bytearray, int]:
        """The values of a native document, or NULL: those of the shader."""
        values = record("mxg_block_info", lib.mxg_result_block, self._handle.pointer, Block(block))
        data = bytearray(0 if values is None else values["byte_size"])
        if not data:
            return data, int(lib.MXG_OK)
        return data, lib.mxg_result_pack_block(self._handle.pointer, document, Block(block), (ctypes.c_char * len(data)).from_buffer(data), len(data))

    def pack_from(self, document: Document, block: Block) -> bytearray:
        """The buffer of a block with the values of another document, for example after an edit of inputs that are uniforms.

        Generates nothing. Raises ValueError if an input of the block has no value there, for example because it is connected.
        """
        from .document import Document # pylint: disable=import-outside-toplevel,redefined-outer-name

        check_type(document, Document, "document")
        data, status = self._packed(document._handle.pointer, block)
        if status == lib.MXG_ERROR_DOCUMENT:
            raise ValueError("an input of the block has no value in the document")
        if status != lib.MXG_OK:
            raise ArgumentError("the document has another library")
        return data

    def pack_value(self, data: bytearray, variable: Variable, values: float | Sequence[float], element: int = 0) -> None:
        """Writes the value of a variable, a number or its components, to its place in a buffer of `pack`. `element` is the light or the
        element of an array."""
        check_type(variable, Variable, "variable")
        if variable._shader is not self:
            raise ValueError(f"'{variable.name}' is a variable of another shader")
        components: Any = (values,) if isinstance(values, Real) else values
        numbers = (ctypes.c_float * len(components))(*components)
        status = lib.mxg_result_pack_value(self._handle.pointer, variable._index, c_number(element, "element"), numbers, len(numbers),
                                           (ctypes.c_char * len(data)).from_buffer(data), len(data))
        if status == lib.MXG_ERROR_ARGUMENT:
            raise ArgumentError(f"'{variable.name}' is in no buffer, has another number of values or no room in the buffer, or is an integer, and "
                                "the value has a fraction or lies beyond 2^24 (pack_from takes it from a document)")
        if status != lib.MXG_OK:
            raise error_of(status)

    @property
    def light_types(self) -> tuple[LightType, ...]:
        """The light shaders."""
        found = []
        for index in range(lib.mxg_result_num_light_types(self._handle.pointer)):
            values = record("mxg_light_type", lib.mxg_result_light_type, self._handle.pointer, index)
            assert values is not None
            members = tuple(self._light_member(index, member) for member in range(values.pop("num_members")))
            found.append(LightType(**values, members=members))
        return tuple(found)

    def _light_member(self, light: int, member: int) -> Variable | None:
        index = lib.mxg_result_light_member(self._handle.pointer, light, member)
        return None if index == lib.MXG_NONE else self._variable(index)

    @property
    def reflection_json(self) -> str:
        """The variables, inputs and info as JSON (docs/reflection.md)."""
        text = lib.mxg_result_reflection_json(self._handle.pointer, None)
        if not text:
            raise OutOfMemoryError("there is no shader, or no memory for the text")
        return py_text(text)

    def reflection(self) -> dict[str, Any]:
        """`reflection_json`, parsed."""
        parsed: dict[str, Any] = json.loads(self.reflection_json)
        return parsed

    def _text(self) -> str:
        """The text of an inspection."""
        return py_text(lib.mxg_result_text(self._handle.pointer, None))


def semantics() -> tuple[Semantic, ...]:
    """The meanings of variables without a path."""
    found = []
    for index in range(lib.mxg_catalogue_num_semantics()):
        values = record("mxg_semantic", lib.mxg_catalogue_semantic, index)
        assert values is not None
        values["block"] = Block(values["block"])
        found.append(Semantic(**values))
    return tuple(found)


# ---- Options ----

class _Options(Native):
    """The options of one call."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    def set(self, key: str, value: str) -> None:
        status = lib.mxg_options_set(self._handle.pointer, c_text(key, "the key of an option"), c_text(value, f"option '{key}'"))
        if status == lib.MXG_ERROR_ARGUMENT:
            raise ArgumentError(sized_text(lambda out, capacity: lib.mxg_options_error(self._handle.pointer, out, capacity)))
        if status != lib.MXG_OK:
            raise error_of(status)


def make_options(context: Context, values: Mapping[str, OptionValue]) -> _Options:
    """The native options of a call with the context."""
    if not isinstance(values, Mapping):
        raise TypeError(f"options must be a mapping, not {type(values).__name__}")
    made = _Options(context._make(lib.mxg_options_create, lib.mxg_options_destroy, ())[0])
    for key, value in values.items():
        if isinstance(value, bool):
            made.set(key, "true" if value else "false")
        elif isinstance(value, Real):
            made.set(key, str(value))
        elif isinstance(value, str):
            made.set(key, value)
        elif isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
            for item in value:
                made.set(key, item)
        else:
            raise TypeError(f"option '{key}' must be bool, int, float, str or a sequence of str, not {type(value).__name__}")
    return made
