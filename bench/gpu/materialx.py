#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes MaterialX's shaders for `bench-device --materialx FOLDER`: those of its Vulkan generator for the first material of each document, in
both interfaces, with three kinds of lights and a transparent output where the material has one. Needs MaterialX's Python package, glslangValidator
and spirv-cross. Arguments: FOLDER, documents; writes FOLDER/INTERFACE/DOCUMENT.vert, .frag and .json."""
import json
import os
import pathlib
import sys

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as mx_glsl
import MaterialX.PyMaterialXGenShader as mx_shader
import reflect

INTERFACES = {"complete": mx_shader.ShaderInterfaceType.SHADER_INTERFACE_COMPLETE, "reduced": mx_shader.ShaderInterfaceType.SHADER_INTERFACE_REDUCED}
LIGHTS = "ND_directional_light", "ND_point_light", "ND_spot_light"  # numbers from 1, as mxgen's
NUM_LIGHTS = 3


def unit_system(target, library):
    system, registry = mx_shader.UnitSystem.create(target), mx.UnitConverterRegistry.create()
    for name in "distance", "angle":
        definition = library.getUnitTypeDef(name)
        registry.addUnitConverter(definition, mx.LinearUnitConverter.create(definition))
    system.loadLibrary(library)
    system.setUnitConverterRegistry(registry)
    return system


def context_of(generator, library, search):
    context = mx_shader.GenContext(generator)
    context.registerSourceCodeSearchPath(search)
    generator.registerTypeDefs(library)
    colours = mx_shader.DefaultColorManagementSystem.create(generator.getTarget())
    colours.loadLibrary(library)
    generator.setColorManagementSystem(colours)
    generator.setUnitSystem(unit_system(generator.getTarget(), library))
    options = context.getOptions()
    options.targetDistanceUnit = "meter"
    options.hwMaxActiveLightSources = NUM_LIGHTS
    for number, name in enumerate(LIGHTS, 1):
        mx_shader.HwShaderGenerator.bindLightShader(library.getNodeDef(name), number, context)
    return context


def flat(value):
    """A value as the numbers of a reflection: those of a matrix stand in the order of memory."""
    if isinstance(value, (mx.Matrix33, mx.Matrix44)):
        size = 3 if isinstance(value, mx.Matrix33) else 4
        return [value[row, column] for row in range(size) for column in range(size)]
    return value if isinstance(value, (bool, int, float)) else list(value)


def ports_of(shader):
    """The uniforms of both stages by name."""
    blocks = [block for stage in (mx_shader.VERTEX_STAGE, mx_shader.PIXEL_STAGE) for block in shader.getStage(stage).getUniformBlocks().values()]
    return {block[i].getVariable(): block[i] for block in blocks for i in range(len(block))}


def known_of(port):
    """What the generator knows of a uniform."""
    value = port.getValue()
    value = value.getData() if hasattr(value, "getData") else value
    if port.getType().getName() == "filename":
        return {"path": port.getPath(), "file": value or ""}
    if value is None:
        return {"path": port.getPath()}
    return {"path": port.getPath(), "default": int(value) if isinstance(value, str) else flat(value)}  # the number of texture coordinates is a text


def write(shader, stem):
    paths = [stem.with_suffix(f".{ending}") for ending in ("vert", "frag")]
    for path, stage in zip(paths, (mx_shader.VERTEX_STAGE, mx_shader.PIXEL_STAGE)):
        path.write_text(shader.getSourceCode(stage), encoding="utf-8")
    reflection, ports = reflect.reflection(*paths), ports_of(shader)
    for block in reflection["blocks"]:
        for variable in block["variables"]:
            variable.update(known_of(ports[variable["name"]]) if variable["name"] in ports else {})
    stem.with_suffix(".json").write_text(json.dumps({"generator": f"MaterialX {mx.getVersionString()}", **reflection}, indent=1), encoding="utf-8")


def main():
    folder, search, library = pathlib.Path(sys.argv[1]), mx.getDefaultDataSearchPath(), mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), search, library)
    generator = mx_glsl.VkShaderGenerator.create()
    context = context_of(generator, library, search)
    for path in map(pathlib.Path, sys.argv[2:]):
        document = mx.createDocument()
        try:
            mx.readFromXmlFile(document, os.fspath(path), mx.FileSearchPath(os.fspath(path.parent)))
        except mx.ExceptionFileMissing as error:
            print(f"{path}: left out: {error}", file=sys.stderr)
            continue
        document.setDataLibrary(library)
        element = mx_shader.findRenderableElements(document)[0]
        for name, interface in INTERFACES.items():
            options = context.getOptions()
            options.shaderInterfaceType = interface
            options.hwTransparency = mx_shader.isTransparentSurface(element, generator.getTarget())
            (folder / name).mkdir(parents=True, exist_ok=True)
            write(generator.generate(mx.createValidName(element.getName()), element, context), folder / name / path.stem)


if __name__ == "__main__":
    main()
