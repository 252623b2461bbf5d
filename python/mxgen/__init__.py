# SPDX-License-Identifier: Apache-2.0
"""mxgen compiles MaterialX documents to shaders.

    import mxgen

    document = mxgen.Context().load("gold.mtlx")
    shader = document.generate("glsl")
    print(shader.pixel)

docs/python.md is the guide; the C library's header, include/mxgen/mxgen.h, has every detail."""
from . import usd
from .catalogue import Option, OptionType, PassMember, PassResource, Target, option_applies, options, pass_resources, targets
from .context import Context, File, ListFolder, ReadTexels, Resolver, Rewriting
from .definition import Implementation, Library, NodeDef, Port, UserInterface
from .diagnostic import Diagnostic, DiagnosticKind, Diagnostics, Severity, color_difference, diagnostic_kinds, library_version
from .document import Connection, Document, Edge, Element, Item, Renderable, Rewritten, Value, equal
from .edit import Draft, Edit, NewValue
from .error import ArgumentError, CancelledError, DocumentError, EditError, Error, InternalError, MissingFileError, OutOfMemoryError
from .files import ZipFiles
from .render import RenderError, bake, render, render_picture
from .scene import (Bindings, BindingsFormat, Fact, FactKind, Layer, LayerKind, NewPrimitive, Primitive, Property, Scene, SlotBinding,
                    Stack, decode_slot, encode_slot)
from .shader import (Alpha, Block, BlockInfo, Change, CompiledInput, InputState, LightType, OptionValue, Part, PassInfo, Place, Semantic,
                     Shader, ShaderInfo, Stage, Storage, Tile, Variable, View, semantics)

__version__ = library_version()

__all__ = ["Alpha", "ArgumentError", "Bindings", "BindingsFormat", "Block", "BlockInfo", "CancelledError", "Change",
           "CompiledInput", "Connection", "Context", "Diagnostic", "DiagnosticKind", "Diagnostics", "Document",
           "DocumentError", "Draft", "Edge", "Edit", "EditError", "Element", "Error", "Fact", "FactKind", "File", "Implementation", "InputState", "InternalError", "Item",
           "Layer", "LayerKind", "Library", "LightType", "ListFolder", "MissingFileError", "NewPrimitive", "NewValue", "NodeDef", "Option", "OptionType",
           "OptionValue", "OutOfMemoryError", "Part", "PassInfo", "PassMember", "PassResource", "Place", "Port", "Primitive", "Property",
           "ReadTexels", "RenderError", "Renderable", "Resolver", "Rewriting", "Rewritten", "Scene", "Semantic", "Severity", "Shader", "ShaderInfo", "SlotBinding",
           "Stack", "Stage", "Storage", "Target", "Tile", "UserInterface", "Value", "Variable", "View", "ZipFiles", "bake", "color_difference", "decode_slot", "diagnostic_kinds", "encode_slot",
           "equal", "library_version", "option_applies", "options", "pass_resources", "render", "render_picture", "semantics", "targets", "usd"]
