# SPDX-License-Identifier: Apache-2.0
"""A document per definition of a library: the node with its default values, and a way to draw each output. Inputs of closures and
shaders are connected, because they have no defaults."""
import pathlib
import re
import xml.etree.ElementTree as ElementTree

# Sources for inputs without defaults.
SOURCES = {
    "BSDF": '<oren_nayar_diffuse_bsdf name="{name}" type="BSDF"/>',
    "EDF": '<uniform_edf name="{name}" type="EDF"/>',
    "VDF": '<anisotropic_vdf name="{name}" type="VDF"><input name="absorption" type="vector3" value="1, 2, 3"/></anisotropic_vdf>',
    "surfaceshader": '<surface_unlit name="{name}" type="surfaceshader"/>',
    "displacementshader": '<displacement name="{name}" type="displacementshader">'
                          '<input name="displacement" type="float" value="0.1"/></displacement>',
    "volumeshader": '<volume name="{name}" type="volumeshader"/>',
}
# Nodes that draw an output: category, type, and the input that takes the output.
DRAWN_BY = {
    "BSDF": ("surface", "surfaceshader", "bsdf"),
    "EDF": ("surface", "surfaceshader", "edf"),
    "VDF": ("volume", "volumeshader", "vdf"),
    "surfaceshader": ("surfacematerial", "material", "surfaceshader"),
    "displacementshader": ("surfacematerial", "material", "displacementshader"),
    "volumeshader": ("volumematerial", "material", "volumeshader"),
    "matrix33": ("determinant", "float", "in"),
    "matrix44": ("determinant", "float", "in"),
    "filename": ("image", "color3", "file"),
    "string": ("geompropvalue", "float", "geomprop"),
}
LIT = '  <oren_nayar_diffuse_bsdf name="lobe" type="BSDF"/>\n' \
      '  <surface name="lit" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="lobe"/></surface>\n'


def draw(type_, reference, name):
    """Elements that draw an output of a type; the last one can be rendered."""
    if type_ in DRAWN_BY:
        category, result, port = DRAWN_BY[type_]
        node = f'  <{category} name="{name}" type="{result}"><input name="{port}" type="{type_}" {reference}/></{category}>\n'
        return node + draw(result, f'nodename="{name}"', f"{name}_drawn")
    if type_ == "material":
        return ""
    return f'  <output name="{name}" type="{type_}" {reference}/>\n'


def document(definition, prefix):
    """The text of the document; None: nothing draws the node. `prefix` is the namespace of the file, with its colon."""
    prefix = f"{definition.get('namespace')}:" if definition.get("namespace") else prefix
    outputs = definition.findall("output")
    type_ = outputs[0].get("type") if len(outputs) == 1 else "multioutput"
    if type_ == "lightshader":  # every lit surface has the default lights
        return f'<materialx version="1.39">\n{LIT}</materialx>\n' if definition.get("node") != "light" else None
    sources, inputs = "", ""
    for port in definition.findall("input"):
        if port.get("type") in SOURCES:
            name = f"source_{port.get('name')}"
            sources += f"  {SOURCES[port.get('type')].format(name=name)}\n"
            inputs += f'<input name="{port.get("name")}" type="{port.get("type")}" nodename="{name}"/>'
    version = f' version="{definition.get("version")}"' if definition.get("version") else ""
    node = prefix + definition.get("node")
    text = f'{sources}  <{node} name="n" type="{type_}" nodedef="{prefix}{definition.get("name")}"{version}>{inputs}</{node}>\n'
    for output in outputs:
        reference = 'nodename="n"' + (f' output="{output.get("name")}"' if len(outputs) > 1 else "")
        text += draw(output.get("type"), reference, f"drawn_{output.get('name')}")
    if any(output.get("type") == "displacementshader" for output in outputs):
        text = LIT + text.replace('<input name="displacementshader"', '<input name="surfaceshader" type="surfaceshader" nodename="lit"/>'
                                  '<input name="displacementshader"')
    return f'<materialx version="1.39">\n{text}</materialx>\n'


RAW = re.compile(r"&(?!(?:lt|gt|amp|quot|apos|#\d+|#x[0-9a-fA-F]+);)")  # as MaterialX's libraries up to 1.39.4 have it


def write(libraries, folder):
    """Writes the documents; returns the names of the definitions that have one, and of the others."""
    written, others = [], []
    for file in sorted(pathlib.Path(libraries).rglob("*.mtlx")):
        root = ElementTree.fromstring(RAW.sub("&amp;", file.read_text()))
        prefix = f"{root.get('namespace')}:" if root.get("namespace") else ""
        for definition in root.iter("nodedef"):
            text = document(definition, prefix) if definition.findall("output") else None
            (written if text else others).append(definition.get("name"))
            if text:
                (folder / f"{definition.get('name')}.mtlx").write_text(text)
    return written, others
