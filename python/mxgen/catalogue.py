# SPDX-License-Identifier: Apache-2.0
"""The targets and the options of generation, for lists and user interfaces."""
from __future__ import annotations

import enum
from dataclasses import dataclass

from ._calls import lib, record


@dataclass(frozen=True)
class Target:
    """A language that mxgen writes."""

    name: str
    #: MaterialX's name of the target
    materialx_name: str
    brief: str
    #: file endings of the vertex and the pixel stage; None: no such stage
    stage_suffix: tuple[str | None, str | None]
    #: of the passes of the deferred pipeline: of a compute stage, of functions alone; None: the target has no passes
    pass_suffix: tuple[str | None, str | None]


class OptionType(enum.IntEnum):
    """The type of an option."""

    BOOL = lib.MXG_OPTION_BOOL
    INT = lib.MXG_OPTION_INT
    STRING = lib.MXG_OPTION_STRING
    ENUM = lib.MXG_OPTION_ENUM
    LIST = lib.MXG_OPTION_LIST
    FLOAT = lib.MXG_OPTION_FLOAT


@dataclass(frozen=True)
class Option:
    """An option of generation."""

    key: str
    type: OptionType
    #: ENUM: "complete|authored|reduced"; INT: "0..1024"
    values: str
    #: the default, as text
    initial: str
    doc: str


@dataclass(frozen=True)
class PassMember:
    """A member of a buffer of the deferred pipeline."""

    #: as in the source: "mx_to_world"
    name: str
    #: "mat4", or the name of a struct
    type: str
    #: the words of its numbers, from 0, separated by '|'; "": any number
    values: str
    doc: str
    #: "tile" or "pixel": the array is as long for each of them; "": one array
    per: str
    #: in bytes, from the buffer or the struct
    offset: int
    #: 0: no array
    array_length: int
    array_stride: int
    #: 0: no matrix
    matrix_stride: int
    #: in the struct that is the type of the last member before that is not nested
    is_nested: bool


@dataclass(frozen=True)
class PassResource:
    """A resource that the passes of the deferred pipeline share; its binding is its place in `pass_resources()`."""

    name: str
    #: "image2D", "image2DArray", "sampler2D", "buffer" or "uniform"
    kind: str
    #: "r32ui"; "any": every format of floats; "std430", "std140": of buffers; "": of samplers
    format: str
    doc: str
    #: of "image2DArray"; 0 of "words": as many as the materials need
    num_layers: int
    #: of a buffer, without its arrays per tile or pixel
    byte_size: int
    #: of a buffer
    members: tuple[PassMember, ...]


def _pass_members(resource: int, count: int) -> tuple[PassMember, ...]:
    found = []
    for index in range(count):
        values = record("mxg_pass_member", lib.mxg_catalogue_pass_member, resource, index)
        assert values is not None
        found.append(PassMember(**values))
    return tuple(found)


def pass_resources() -> tuple[PassResource, ...]:
    """The resources of the deferred pipeline."""
    found = []
    for index in range(lib.mxg_catalogue_num_pass_resources()):
        values = record("mxg_pass_resource", lib.mxg_catalogue_pass_resource, index)
        assert values is not None
        values["members"] = _pass_members(index, values.pop("num_members"))
        found.append(PassResource(**values))
    return tuple(found)


def targets() -> tuple[Target, ...]:
    """Every target."""
    found = []
    for index in range(lib.mxg_catalogue_num_targets()):
        values = record("mxg_target", lib.mxg_catalogue_target, index)
        assert values is not None
        found.append(Target(**values))
    return tuple(found)


def options() -> tuple[Option, ...]:
    """Every option of `Document.generate`."""
    found = []
    for index in range(lib.mxg_catalogue_num_options()):
        values = record("mxg_option", lib.mxg_catalogue_option, index)
        assert values is not None
        values["type"] = OptionType(values["type"])
        found.append(Option(**values))
    return tuple(found)


def option_applies(key: str, target: str) -> bool:
    """Whether an option has a meaning for a target, which ignores the others.

    Raises ValueError for an option or a target that does not exist.
    """
    keys = [option.key for option in options()]
    if key not in keys:
        raise ValueError(f"there is no option '{key}'")
    if target not in [known.name for known in targets()]:
        raise ValueError(f"there is no target '{target}'")
    return bool(lib.mxg_catalogue_has_option(keys.index(key), target.encode()))
