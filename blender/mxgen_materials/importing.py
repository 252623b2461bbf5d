# SPDX-License-Identifier: Apache-2.0
"""MaterialX documents as Principled materials."""
from __future__ import annotations

import pathlib

import bpy
import mxgen

from .baking import Baking, bake, surface_of, translate_unknown
from .losses import Loss
from .mapping import MODELS, specular_of

IMAGES = ("image", "tiledimage")
EXTENSIONS = {"clamp": "EXTEND", "constant": "CLIP", "periodic": "REPEAT", "mirror": "REPEAT"}


class _Importer:
    """The conversion of one surface shader."""

    def __init__(self, material: bpy.types.Material, shader: mxgen.Element, folder: pathlib.Path) -> None:
        self.material, self.shader, self.folder = material, shader, folder
        self.model = MODELS[shader.category]
        self.losses: list[Loss] = []
        definition = shader.definition
        self.ports = {port.name: port for port in definition.inputs} if definition else {}
        material.use_nodes = True
        self.tree = material.node_tree
        self.tree.nodes.clear()
        self.bsdf = self.tree.nodes.new("ShaderNodeBsdfPrincipled")
        self.bsdf.distribution = "MULTI_GGX" # keeps energy, as the models of MaterialX do
        output = self.tree.nodes.new("ShaderNodeOutputMaterial")
        output.location.x = 300
        self.tree.links.new(self.bsdf.outputs["BSDF"], output.inputs["Surface"])

    def lose(self, what: str, reason: str, is_graph: bool = False) -> None:
        self.losses.append(Loss(self.material.name, what, reason, is_graph))

    # ---- Values ----

    def default(self, name: str) -> object:
        port = self.ports.get(name)
        return _numbers(port.value) if port and port.value else None

    def constant(self, name: str) -> object:
        """The value of an input; a connection counts as lost."""
        element = self.shader.child(name)
        if element is None:
            return self.default(name)
        if element.connection is not None:
            self.lose(name, "a texture or graph cannot be a factor here; its default counts")
            return self.default(name)
        return element.value if element.value is not None else self.default(name)

    # ---- Sockets ----

    def set_socket(self, socket: bpy.types.NodeSocket, value: object) -> None:
        if socket.type == "RGBA":
            numbers = list(value) if isinstance(value, tuple) else [float(value)] * 3
            socket.default_value = (*numbers[:3], 1.0)
        elif socket.type == "VECTOR":
            socket.default_value = value if isinstance(value, tuple) else (float(value),) * 3
        else:
            socket.default_value = sum(value) / len(value) if isinstance(value, tuple) else float(value)

    def image_node(self, source: mxgen.Element, what: str) -> bpy.types.Node | None:
        file, prefix = source.child("file"), ""
        if file is None or not file.value:
            self.lose(what, "the image has no file")
            return None
        holder = file
        while holder is not None: # the nearest fileprefix around it
            prefix = holder.get("fileprefix") or ""
            if prefix:
                break
            holder = holder.parent
        path = self.folder / (prefix + str(file.value).replace("<UDIM>", "1001"))
        space = next((space for space in (file.get("colorspace"), source.get("colorspace")) if space), "")
        image = _load(str(path), "sRGB" if space.startswith(("srgb", "gamma22")) else "Non-Color")
        if image is None:
            self.lose(what, f"the texture '{path}' cannot be read")
            return None
        if "<UDIM>" in str(file.value):
            image.source = "TILED"
        node = self.tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        mode = source.child("uaddressmode")
        node.extension = EXTENSIONS.get(str(mode.value) if mode is not None else "periodic", "REPEAT")
        tiling = source.child("uvtiling")
        if tiling is not None and tiling.value is None:
            self.lose(what, "the tiling comes from a graph; the texture is not tiled", is_graph=True)
        elif tiling is not None and tiling.value != (1.0, 1.0):
            mapping, place = self.tree.nodes.new("ShaderNodeMapping"), self.tree.nodes.new("ShaderNodeTexCoord")
            mapping.inputs["Scale"].default_value = (*tiling.value, 1.0)
            self.tree.links.new(place.outputs["UV"], mapping.inputs["Vector"])
            self.tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
        texcoord = source.child("texcoord")
        if texcoord is not None and texcoord.connection is not None:
            self.lose(what, "the texture coordinates come from a graph; the active ones are used", is_graph=True)
        return node

    def source_of(self, element: mxgen.Element) -> mxgen.Element | None:
        """The node that a connection ends at, through outputs of nodegraphs and conversions that Blender does by itself."""
        for _ in range(100):
            connection = element.connection
            source = connection.source if connection is not None else None
            if source is None:
                return None
            if source.category == "nodegraph":
                outputs = [output for output in source.outputs if output.name == connection.output] or list(source.outputs)
                if not outputs:
                    return None
                element = outputs[0]
            elif source.category == "input":
                element = source
            elif source.category in ("convert", "luminance") and source.child("in") is not None:
                element = source.child("in")
            elif source.category == "extract" and (inner := self.source_element(source)) is not None and inner.category == "luminance":
                element = source.child("in")
            else:
                return source
        return None

    @staticmethod
    def source_element(node: mxgen.Element) -> mxgen.Element | None:
        """The node at the input `in`, if it is connected directly."""
        element = node.child("in")
        return element.connection.source if element is not None and element.connection is not None else None

    def connect(self, element: mxgen.Element, socket: bpy.types.NodeSocket) -> bool:
        """Links a texture or a normal map to a socket, or tells why its file is lost. False: the document has something else there."""
        source = self.source_of(element)
        if source is None:
            return False
        if source.category == "normalmap" and socket.name in ("Normal", "Clearcoat Normal"):
            picture = source.child("in")
            image = self.source_of(picture) if picture is not None else None
            if image is None or image.category not in IMAGES:
                return False
            node = self.image_node(image, element.name)
            if node is None:
                return True
            bump = self.tree.nodes.new("ShaderNodeNormalMap")
            scale = source.child("scale")
            bump.inputs["Strength"].default_value = float(scale.value) if scale is not None and isinstance(scale.value, float) else 1.0
            self.tree.links.new(node.outputs["Color"], bump.inputs["Color"])
            self.tree.links.new(bump.outputs["Normal"], socket)
            return True
        if source.category not in IMAGES:
            return False
        node = self.image_node(source, element.name)
        if node is not None:
            self.tree.links.new(node.outputs["Color"], socket)
        return True

    def convert_socket(self, name: str, input_name: str) -> None:
        socket, element = self.bsdf.inputs[name], self.shader.child(input_name)
        if element is not None and element.connection is not None:
            if self.connect(element, socket):
                if name in self.model.scales:
                    self.lose(input_name, f"the texture is not scaled: 1 in Blender is {self.model.scales[name]:g} in the document")
            else:
                self.lose(input_name, "the graph has no counterpart: only images and normal maps are converted", is_graph=True)
                value = self.default(input_name)
                if value is not None:
                    self.set_socket(socket, value)
            return
        value = element.value if element is not None else self.default(input_name)
        if value is None or isinstance(value, str):
            return
        factor = self.constant(self.model.factors[name]) if name in self.model.factors else 1.0
        if factor not in (1.0, None):
            value = tuple(x * factor for x in value) if isinstance(value, tuple) else value * factor
        scale = self.model.scales.get(name, 1)
        if scale != 1 and value > scale:
            self.lose(input_name, f"the socket reflects as much as the value {scale:g} at most; the value was {value:g}")
        self.set_socket(socket, min(value / scale, 1) if scale != 1 else value)

    # ---- The shader ----

    def has_no_effect(self, element: mxgen.Element) -> bool:
        """Whether the Principled BSDF needs no socket for an input: its weight is 0, or it has the value that is built in."""
        for beginning, weight in self.model.weights.items():
            holder = self.shader.child(weight)
            if element.name.startswith(beginning) and element.name != weight and (holder is None or holder.connection is None):
                value = holder.value if holder is not None else self.default(weight)
                if value in (0, (0.0, 0.0, 0.0)):
                    return True
        implied = self.model.implied.get(element.name)
        if isinstance(implied, str):
            other = self.shader.child(implied)
            implied = other.value if other is not None else self.default(implied)
        return implied is not None and element.connection is None and _same(element.value, implied)

    def convert(self) -> None:
        model = self.model
        for name, input_name in {**model.sockets, **model.means}.items():
            self.convert_socket(name, input_name)
            value = self.constant(input_name) if name in model.means else None
            if isinstance(value, tuple) and max(value) != min(value):
                self.lose(input_name, "the socket has one number; the mean counts")
        handled = {*model.sockets.values(), *model.factors.values(), *model.means.values()}
        if model.specular:
            weight, ior = (self.constant(name) for name in model.specular)
            self.bsdf.inputs["Specular"].default_value = specular_of(1.0 if weight is None else weight, 1.5 if ior is None else ior)
            handled |= set(model.specular)
        if model.radius:
            scale, colour = (self.constant(name) for name in model.radius)
            self.bsdf.inputs["Subsurface Radius"].default_value = tuple(scale * x for x in colour)
            handled |= set(model.radius)
        handled |= self.colour_layers()
        for element in self.shader.inputs:
            if element.name in handled or self.has_no_effect(element):
                continue
            if element.connection is not None:
                self.lose(element.name, "the Principled BSDF has no such socket")
            elif not _same(element.value, self.default(element.name)):
                self.lose(element.name, f"the Principled BSDF has no such socket; the value was {element.get('value')}")
        self.lose_defaults()
        alpha = self.bsdf.inputs["Alpha"]
        if alpha.is_linked or alpha.default_value < 1:
            self.material.blend_method = "BLEND"


    def colour_layers(self) -> set[str]:
        """The Principled BSDF has one colour for what lies below the coat: that of the transmitted light where all is transmitted, and
        otherwise that of the base; the coat multiplies it. Returns the inputs that it then has."""
        colour, handled = self.bsdf.inputs["Base Color"], set()
        for layer, beginning in ("Transmission", "transmission_"), ("Clearcoat", "coat_"):
            weight_name, tint_name = self.model.sockets.get(layer, ""), f"{beginning}color"
            weight, tint = self.shader.child(weight_name), self.shader.child(tint_name)
            if weight is None or weight.connection is not None or tint_name not in self.ports or (tint is not None and tint.connection is not None):
                continue
            amount, value = self.constant(weight_name), self.constant(tint_name)
            if layer == "Transmission" and amount == 1:
                for link in list(colour.links):
                    self.tree.links.remove(link)
                self.set_socket(colour, value)
                handled.add(tint_name)
            elif layer == "Clearcoat" and not colour.is_linked:
                self.set_socket(colour, tuple(x * (1 - amount + amount * y) for x, y in zip(colour.default_value, value)))
                handled.add(tint_name)
        return handled

    def lose_defaults(self) -> None:
        """The inputs whose default differs from the value that the Principled BSDF has built in, where their layer is there."""
        for name, implied in self.model.implied.items():
            beginning = next(beginning for beginning in self.model.weights if name.startswith(beginning))
            weight = self.shader.child(self.model.weights[beginning])
            there = weight is not None and (weight.connection is not None or weight.value != 0)
            default = self.default(name)
            if there and self.shader.child(name) is None and isinstance(implied, float) and not _same(default, implied):
                self.lose(name, f"the Principled BSDF has no such socket; the default is {default:g}, and Blender's {implied:g}")


def _load(path: str, space: str) -> bpy.types.Image | None:
    """The image of a file; one image has one colour space. None: the file cannot be read."""
    for image in bpy.data.images:
        if image.filepath == path and image.colorspace_settings.name == space:
            return image
    try:
        image = bpy.data.images.load(path)
    except RuntimeError:
        return None
    image.colorspace_settings.name = space
    return image


def _numbers(text: str) -> object:
    """The value of a default: numbers, or the text."""
    try:
        numbers = tuple(float(word) for word in text.split(","))
    except ValueError:
        return {"true": True, "false": False}.get(text, text)
    return numbers[0] if len(numbers) == 1 else numbers


def _same(one: object, other: object) -> bool:
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(abs(a - b) < 1e-6 for a, b in zip(one, other))
    if isinstance(one, (int, float)) and isinstance(other, (int, float)):
        return abs(one - other) < 1e-6
    return one == other


def _convert(document: mxgen.Document, folder: pathlib.Path) -> tuple[list[bpy.types.Material], list[Loss]]:
    made, losses = [], []
    for element in list(document):
        if element.category != "surfacematerial":
            continue
        shader = surface_of(element)
        if shader is None or shader.category not in MODELS:
            kind = shader.category if shader is not None else "no shader"
            losses.append(Loss(element.name, "surfaceshader", f"'{kind}' has no counterpart; known are {', '.join(MODELS)}"))
            continue
        importer = _Importer(bpy.data.materials.new(element.name), shader, folder)
        importer.convert()
        if element.child("displacementshader") is not None:
            importer.lose("displacementshader", "displacement is not converted")
        made.append(importer.material)
        losses += importer.losses
    return made, losses


def import_file(path: str, baking: Baking | None = None) -> tuple[list[bpy.types.Material], list[Loss]]:
    """Makes a material for each surface material of a document. With `baking`, graphs become images, and surfaces of other models become
    those of the export. Raises mxgen.DocumentError; then nothing is made."""
    document = mxgen.Context().load(path)
    found = document.validate()
    if found.errors:
        raise mxgen.DocumentError(found, document)
    earlier: list[Loss] = []
    if baking is not None:
        document = translate_unknown(document, path, earlier)
    made, losses = _convert(document, pathlib.Path(path).resolve().parent)
    if baking is None or not any(loss.is_graph for loss in losses):
        return made, earlier + losses
    try:
        document, flat = bake(document, baking)
    except mxgen.RenderError as error:
        return made, [*earlier, Loss(pathlib.Path(path).name, "graphs", f"they cannot be images: {error}"), *losses]
    for material in made:
        bpy.data.materials.remove(material)
    made, losses = _convert(document, flat.resolve().parent)
    return made, earlier + losses
