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
class PassResource:
    """A resource that the passes of the deferred pipeline share; its binding is its place in `pass_resources()`."""

    name: str
    #: "image2D", "image2DArray", "sampler2D", "buffer" or "uniform"
    kind: str
    #: "r32ui", "std430"; "": any
    format: str
    doc: str


def pass_resources() -> tuple[PassResource, ...]:
    """The resources of the deferred pipeline."""
    found = []
    for index in range(lib.mxg_num_pass_resources()):
        values = record("mxg_pass_resource", lib.mxg_get_pass_resource, index)
        assert values is not None
        found.append(PassResource(**values))
    return tuple(found)


def targets() -> tuple[Target, ...]:
    """Every target."""
    found = []
    for index in range(lib.mxg_num_targets()):
        values = record("mxg_target", lib.mxg_get_target, index)
        assert values is not None
        found.append(Target(**values))
    return tuple(found)


def options() -> tuple[Option, ...]:
    """Every option of `Document.generate`."""
    found = []
    for index in range(lib.mxg_num_options()):
        values = record("mxg_option", lib.mxg_get_option, index)
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
    return bool(lib.mxg_option_applies(keys.index(key), target.encode()))
