#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Wide documents, many of them wrong throughout: the work of mxgen grows in proportion to their size, whatever is many of. Counted are
instructions, which do not depend on the machine, so a table can be tight. Arguments: mxgen, [names of shapes…]."""

import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import checks  # noqa: E402

FEW, FACTOR = 300, 8
MOST = 10.5  # times the work for FACTOR times the elements; what is quadratic comes near 64

# A shape is a name, a command ("validate" by default) and parts of a document. A part in a tuple is repeated: '#' stands for a number from
# 0, '^' for the one behind it.
VALUE = "<output name='out' type='float'/>"
GRAPH = "<constant name='c' type='float'/><output name='out' type='float' nodename='c'/>"
GLTF = '{"asset": {"version": "2.0"}, '
SHAPES = [
    ("nodes", ("<constant name='c#' type='float'/>",), ("<output name='o#' type='float' nodename='c#'/>",)),
    ("equal names", ("<constant name='c' type='float'/>",)),
    ("unknown nodes", ("<xadd# name='c#' type='float'/>",)),
    ("unknown types", ("<constant name='c#' type='flot#'/>",)),
    ("views of unknown nodes", "inspect --graph", ("<add name='a#' type='float'><input name='in1' type='float' nodename='xa#'/></add>",)),
    ("views of unknown types", "inspect --graph", ("<constant name='c#' type='flot#'/>",)),
    (
        "definitions of a reference",
        "library doc",
        ("<nodedef name='ND_#' node='n#'><input name='a' type='float' value='1'/><output name='out' type='float'/></nodedef>",),
        ("<nodegraph name='NG#' nodedef='ND_#'><dot name='d' type='float'/><output name='out' type='float' nodename='d'/></nodegraph>",),
    ),
    (
        "graphs of a library with unknown nodes",
        "library pack",
        ("<nodedef name='ND_#' node='n#'><input name='a' type='float' value='1'/><output name='out' type='float'/></nodedef>",),
        ("<nodegraph name='NG#' nodedef='ND_#'><xdot name='d' type='float'/><output name='out' type='float' nodename='d'/></nodegraph>",),
    ),
    ("unknown looks of one group", "<lookgroup name='G' looks='", ("L#,",), "'/>"),
    ("unknown collections in one", "<collection name='C' includecollection='", ("c#,",), "'/>"),
    ("shaders of a material of 1.35", "upgrade", "1.35", "<material name='m'>", ("<shaderref name='s#' node='standard_surface'/>",), "</material>"),
    (
        "materials of a look of 1.37",
        "upgrade",
        "1.37",
        ("<material name='m#'><shaderref name='s#' node='standard_surface'/></material>",),
        "<look name='L'>",
        ("<materialassign name='a#' material='m#' geom='/a#'/>",),
        "</look>",
    ),
    ("unknown attributes", ("<constant name='c#' type='float' typo#='1'/>",)),
    ("attributes of one element", "<constant name='c' type='float' ", ("typo#='1' ",), "/>"),
    ("names that are not ASCII, on one line", ("<constant name='c#' type='float' doc='ü'/> ",)),
    ("warnings on one line", ("<constant name='c#' type='float' typo#='1'/> ",)),
    ("warnings on one line that is long", ("<constant name='c#' type='float' typo#='1' doc='" + "x" * 2000 + "'/> ",)),
    ("declared attributes", ("<attributedef name='A#' attrname='a#' type='string'/>",), ("<constant name='c#' type='float' a#='1'/>",)),
    (
        "words that an input accepts, all used",
        "<nodedef name='D' node='g'><input name='i' type='string' value='' enum='w",
        (",w#" + "x" * 50,),
        "'/>" + VALUE + "</nodedef>",
        ("<g name='g#' type='float'><input name='i' type='string' value='y#'/></g>",),
    ),
    ("unknown inputs", "<constant name='c' type='float'>", ("<input name='i#' type='float' value='0'/>",), "</constant>"),
    ("dangling nodes", ("<add name='a#' type='float'><input name='in1' type='float' nodename='xa#'/></add>",)),
    (
        "dangling interfaces",
        "<nodegraph name='N'>",
        ("<input name='i#' type='float' value='0'/>",),
        ("<dot name='d#' type='float'><input name='in' type='float' interfacename='xi#'/></dot>",),
        "</nodegraph>",
    ),
    ("dangling graphs", ("<nodegraph name='N#'/>",), ("<output name='o#' type='float' nodegraph='xN#'/>",)),
    (
        "dangling outputs",
        "<nodegraph name='N'>",
        ("<output name='o#' type='float' value='1'/>",),
        "</nodegraph>",
        ("<output name='p#' type='float' nodegraph='N' output='xo#'/>",),
    ),
    ("graphs", ("<nodegraph name='N#' namespace='n#'>" + GRAPH + "</nodegraph>",)),
    ("outputs of a graph", "<nodegraph name='N'><constant name='c' type='float'/>", ("<output name='o#' type='float' nodename='c'/>",), "</nodegraph>"),
    (
        "ports that do not name one of a graph's outputs",
        "<nodegraph name='N'><constant name='c' type='float'/><constant name='k' type='color3'/>",
        ("<output name='o#' type='float' nodename='c'/>",),
        "<output name='l' type='color3' nodename='k'/></nodegraph>",
        ("<output name='p#' type='color3' nodegraph='N'/>",),
    ),
    (
        "ports that read the one output behind many nodes",
        "<nodegraph name='N'>",
        ("<constant name='c#' type='float'/>",),
        "<output name='l' type='float' nodename='c0'/></nodegraph>",
        ("<output name='p#' type='float' nodegraph='N'/>",),
    ),
    ("tokens", "<nodegraph name='N'>", ("<token name='T#' type='string' value='a'/><image name='g#' type='float'><input name='file' type='filename' value='[T#].png'/></image>",), "</nodegraph>"),
    (
        "colour spaces",
        ("<constant name='c#' type='color3'><input name='value' type='color3' value='1,1,1' colorspace='srgb_tx#'/></constant>",),
    ),
    (
        "units",
        ("<unittypedef name='t#'/><unitdef name='u#' unittype='t#'><unit name='n#' scale='1'/></unitdef>",),
        ("<constant name='c#' type='float'><input name='value' type='float' value='1' unittype='t#' unit='n#'/></constant>",),
    ),
    (
        "units of one type",
        "<unittypedef name='t'/><unitdef name='u' unittype='t'>",
        ("<unit name='n#' scale='^'/>",),
        "</unitdef>",
        ("<constant name='c#' type='float'><input name='value' type='float' value='1' unittype='t' unit='n#'/></constant>",),
    ),
    (
        "unknown units",
        ("<unitdef name='u#' unittype='t#'><unit name='n#' scale='1'/></unitdef>",),
        ("<constant name='c#' type='float'><input name='value' type='float' value='1' unit='xn#'/></constant>",),
    ),
    ("types", ("<typedef name='t#'><member name='m' type='float' value='1'/></typedef>",), ("<constant name='c#' type='t#'/>",)),
    ("definitions of one node", ("<nodedef name='D#' node='g'>" + VALUE + "</nodedef>",)),
    (
        "versions of one node",
        ("<nodedef name='D#' node='g' version='#.0' isdefaultversion='true'>" + VALUE + "</nodedef>",),
        ("<g name='n#' type='float'/>",),
    ),
    (
        "overloads, all used",
        ("<nodedef name='D#' node='g'><input name='i#' type='float' value='0'/>" + VALUE + "</nodedef>",),
        ("<g name='n#' type='float'><input name='i#' type='float' value='1'/></g>",),
    ),
    ("definitions", ("<nodedef name='D#' node='g#'>" + VALUE + "</nodedef>",), ("<g# name='n#' type='float' nodedef='xD#'/>",)),
    ("ports", "<nodedef name='D' node='g'>", ("<input name='i#' type='float' value='0'/>",), VALUE + "</nodedef>"),
    (
        "implementations",
        "<nodedef name='D' node='g'>" + VALUE + "</nodedef>",
        ("<implementation name='I#' nodedef='D' target='t#' nodegraph='G'/>",),
        "<nodegraph name='G'>" + GRAPH + "</nodegraph>",
    ),
    (
        "implementations for one target",
        "<nodedef name='D' node='g'>" + VALUE + "</nodedef>",
        ("<implementation name='I#' nodedef='D' target='t' nodegraph='G'/>",),
        "<nodegraph name='G'>" + GRAPH + "</nodegraph>",
    ),
    (
        "functional graphs",
        ("<nodedef name='D#' node='g#'>" + VALUE + "</nodedef>",),
        ("<nodegraph name='G#' nodedef='D#'>" + GRAPH + "</nodegraph>",),
    ),
    (
        "functional graphs, all used",
        "-e o",
        ("<nodedef name='D#' node='g#'><input name='in' type='float' value='0'/>" + VALUE + "</nodedef>",),
        (
            "<nodegraph name='G#' nodedef='D#'><sin name='s' type='float'><input name='in' type='float' interfacename='in'/></sin>"
            "<output name='out' type='float' nodename='s'/></nodegraph>",
        ),
        "<time name='n0' type='float'/>",
        ("<g# name='n^' type='float'><input name='in' type='float' nodename='n#'/></g#>",),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "expressions, all used",
        "-e o",
        (
            "<nodedef name='D#' node='g#'><input name='in' type='float' value='0'/>" + VALUE + "</nodedef>"
            "<implementation name='I#' nodedef='D#' sourcecode='{{in}} * {{in}} + #.0'/>",
        ),
        "<time name='n0' type='float'/>",
        ("<g# name='n^' type='float'><input name='in' type='float' nodename='n#'/></g#>",),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "implementations of the document for the library's nodes",
        "-e o",
        ("<implementation name='I#' nodedef='ND_sin_float' target='t#' sourcecode='sin({{in}})'/>",),
        "<time name='n0' type='float'/>",
        ("<cos name='n^' type='float'><input name='in' type='float' nodename='n#'/></cos>",),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "properties of geometry, all used",
        "-e o",
        "<constant name='n0' type='float'/>",
        (
            "<geompropvalue name='p#' type='float'><input name='geomprop' type='string' value='q#'/></geompropvalue>"
            "<add name='n^' type='float'><input name='in1' type='float' nodename='p#'/><input name='in2' type='float' nodename='n#'/></add>",
        ),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "readers of one property, each with a default",
        "-e o",
        "<constant name='n0' type='float'/>",
        (
            "<geompropvalue name='p#' type='float'><input name='geomprop' type='string' value='q'/><input name='default' type='float' value='#'/>"
            "</geompropvalue><add name='n^' type='float'><input name='in1' type='float' nodename='p#'/><input name='in2' type='float' nodename='n#'/></add>",
        ),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "readers of properties, each with the sum of the one before as default",
        "-e o",
        "<constant name='n0' type='float'/>",
        (
            "<geompropvalue name='p#' type='float'><input name='geomprop' type='string' value='q#'/><input name='default' type='float' nodename='n#'/>"
            "</geompropvalue><add name='n^' type='float'><input name='in1' type='float' nodename='p#'/><input name='in2' type='float' value='2'/></add>",
        ),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "textures, all used",
        "-e o",
        "<constant name='n0' type='float'/>",
        (
            "<image name='p#' type='float'><input name='file' type='filename' value='q#.png'/></image>"
            "<add name='n^' type='float'><input name='in1' type='float' nodename='p#'/><input name='in2' type='float' nodename='n#'/></add>",
        ),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "uniforms",
        "-e o",
        "<constant name='n0' type='float'/>",
        ("<add name='n^' type='float'><input name='in1' type='float' value='#'/><input name='in2' type='float' nodename='n#'/></add>",),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "definitions that inherit",
        "<nodedef name='D' node='g'>" + VALUE + "</nodedef>",
        ("<nodedef name='D#' node='g#' inherit='D'/>",),
    ),
    (
        "properties of geometry",
        "<nodedef name='D' node='g'>" + VALUE + "</nodedef>",
        ("<geompropdef name='p#' type='vector3' geomprop='g'/>",),
    ),
    (
        "chains of graphs",
        "<nodegraph name='G0'><input name='in' type='float' value='1'/><output name='out' type='float' interfacename='in'/></nodegraph>",
        (
            "<nodegraph name='G^'><input name='in' type='float' nodegraph='G#'/><dot name='d' type='float'><input name='in' type='float' "
            "interfacename='in'/></dot><output name='out' type='float' nodename='d'/></nodegraph>",
        ),
    ),
    (
        "chains of graphs, all used",
        "-e o",
        "<nodegraph name='G0'><input name='in' type='float' value='1'/><output name='out' type='float' interfacename='in'/></nodegraph>",
        (
            "<nodegraph name='G^'><input name='in' type='float' nodegraph='G#'/><sin name='d' type='float'><input name='in' type='float' "
            "interfacename='in'/></sin><output name='out' type='float' nodename='d'/></nodegraph>",
        ),
        "<output name='o' type='float' nodegraph='G*'/>",
    ),
    (
        "definitions that inherit from the one behind them",
        ("<nodedef name='D#' node='g#' inherit='D^'><input name='i#' type='float' value='0'/></nodedef>",),
        "<nodedef name='D*' node='g*'>" + VALUE + "</nodedef>",
    ),
    (
        "chains of graphs without nodes",
        "<nodegraph name='G0'><input name='in' type='float' value='1'/><output name='out' type='float' interfacename='in'/></nodegraph>",
        ("<nodegraph name='G^'><input name='in' type='float' nodegraph='G#'/><output name='out' type='float' interfacename='in'/></nodegraph>",),
    ),
    (
        "chains of graphs without nodes that lead nowhere",
        "<nodegraph name='G0'><input name='in' type='float' nodename='x'/><output name='out' type='float' interfacename='in'/></nodegraph>",
        ("<nodegraph name='G^'><input name='in' type='float' nodegraph='G#'/><output name='out' type='float' interfacename='in'/></nodegraph>",),
    ),
    (
        "a cycle of graphs without nodes",
        "<nodegraph name='G0'><input name='in' type='float' nodegraph='G*'/><output name='out' type='float' interfacename='in'/></nodegraph>",
        ("<nodegraph name='G^'><input name='in' type='float' nodegraph='G#'/><output name='out' type='float' interfacename='in'/></nodegraph>",),
    ),
    (
        "chains of graphs, each read by a node",
        "-e o",
        "<nodegraph name='G0'><input name='in' type='float' value='1'/><output name='out' type='float' interfacename='in'/></nodegraph>"
        "<constant name='n0' type='float'/>",
        (
            "<nodegraph name='G^'><input name='in' type='float' nodegraph='G#' output='out'/><sin name='d' type='float'><input name='in' "
            "type='float' interfacename='in'/></sin><output name='out' type='float' interfacename='in'/><output name='s' type='float' "
            "nodename='d'/></nodegraph><add name='n^' type='float'><input name='in1' type='float' nodegraph='G^' output='s'/>"
            "<input name='in2' type='float' nodename='n#'/></add>",
        ),
        "<output name='o' type='float' nodename='n*'/>",
    ),
    (
        "looks",
        ("<look name='l#'><materialassign name='a' material='x#' geom='/g'/></look>",),
        "<surface name='s' type='surfaceshader'/>",
        ("<surfacematerial name='x#' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>",),
    ),
    ("materials without a shader", ("<surface name='s#' type='surfaceshader'/><surfacematerial name='x#' type='material'/>",)),
    ("looks that inherit and assign nothing", "<look name='l0'/>", ("<look name='l^' inherit='l#'/>",)),
    ("looks that inherit", "<look name='l0'/>", ("<look name='l^' inherit='l#'><materialassign name='a' material='x' geom='/g'/></look>",)),
    (
        "variants",
        "<variantset name='v'>",
        ("<variant name='x#'><input name='a' type='float' value='1'/></variant>",),
        "</variantset><look name='L'>",
        ("<variantassign name='a#' variantset='v' variant='x#'/>",),
        "</look>",
    ),
    ("collections", ("<collection name='c^' includecollection='c#'/>",)),
    ("geometry", ("<collection name='c#' includegeom='/a[,/b{,/c#'/>",)),
    ("targets that inherit", "<targetdef name='t0'/>", ("<targetdef name='t^' inherit='t#'/>",)),
    (
        "materials of 1.37",
        "1.37",
        (
            "<material name='M#'><shaderref name='S' node='standard_surface'><bindinput name='base' type='float' value='1'/></shaderref>"
            "</material>",
        ),
    ),
    (
        "materials of 1.37 with shaders of the document",
        "1.37",
        ("<nodedef name='D#' node='g#'><output name='out' type='surfaceshader'/></nodedef>",),
        ("<material name='M#'><shaderref name='S#' node='g#'/></material>",),
    ),
    (
        "materials of 1.37 that inherit",
        "1.37",
        "<material name='M0'><shaderref name='S' node='standard_surface'/></material>",
        ("<material name='M^'><materialinherit name='i' material='M#'/></material>",),
    ),
    (
        "materials of 1.34 with overrides",
        "1.34",
        "<nodedef name='D' node='g' type='surfaceshader'>",
        ("<input name='i#' type='float' value='0' publicname='p#'/>",),
        "</nodedef><material name='M'><shaderref name='S' node='g'/>",
        ("<override name='p#' type='float' value='1'/>",),
        "</material>",
    ),
    ("tiles of 1.33", "1.33", ("<geominfo name='g#' geom='/a#'><geomattr name='udim' type='string' value='####'/></geominfo>",)),
    (
        "swizzles of 1.38",
        "1.38",
        "<constant name='c' type='color3'/>",
        (
            "<swizzle name='s#' type='float'><input name='in' type='color3' nodename='c'/>"
            "<input name='channels' type='string' value='r'/></swizzle>",
        ),
    ),
    (
        "channels of 1.38 in nested graphs",
        "1.38",
        (
            "<nodegraph name='N#'><constant name='c' type='color3'/><sin name='s' type='float'><input name='in' type='float' "
            "nodename='c' channels='r'/></sin><output name='out' type='float' nodename='s'/></nodegraph>",
        ),
    ),
    (
        "channels of 1.38 in one graph",
        "1.38",
        "<nodegraph name='N'><constant name='c' type='color3'/>",
        ("<sin name='s#' type='float'><input name='in' type='float' nodename='c' channels='r'/></sin>",),
        "<output name='out' type='float' nodename='s0'/></nodegraph>",
    ),
    (
        "a set of tiles",
        "-e o",
        "<geominfo name='g' geom='*'><geomprop name='udimset' type='stringarray' value='1001",
        (", 1%",),
        "'/></geominfo><image name='i' type='color3'><input name='file' type='filename' value='a.&lt;UDIM&gt;.png'/></image>"
        "<output name='o' type='color3' nodename='i'/>",
    ),
    ("materials of glTF", "import", GLTF + '"materials": [', ('{"name": "m#"},',), "{}]}"),
    ("materials of glTF with one name", "import", GLTF + '"materials": [', ('{"name": "m"},',), "{}]}"),
    (
        "variants of glTF with one name",
        "import",
        GLTF + '"materials": [{}], "extensions": {"KHR_materials_variants": {"variants": [',
        ('{"name": "v"},',),
        "{}]}}}",
    ),
    (
        "nodes of glTF with one name",
        "import",
        GLTF + '"materials": [{}], "extensions": {"KHR_materials_variants": {"variants": [{}]}}, "meshes": [{"primitives": [{"material": 0}]}],'
        '"scenes": [{"nodes": [',
        ("^,",),
        '0]}], "nodes": [',
        ('{"name": "n", "mesh": 0},',),
        '{"mesh": 0}]}',
    ),
    (
        "tiles that are none",
        "-e o",
        "<geominfo name='g' geom='*'><geomprop name='udimset' type='stringarray' value='x",
        (", x#",),
        "'/></geominfo><image name='i' type='color3'><input name='file' type='filename' value='a.&lt;UDIM&gt;.png'/></image>"
        "<output name='o' type='color3' nodename='i'/>",
    ),
]


def document(shape, count):
    """The command and the text."""
    command, version, parts = ["validate"], "1.39", list(shape[1:])
    if isinstance(parts[0], str) and parts[0].startswith("-"):
        command = parts.pop(0).split() + ["--stdout"]
    elif parts[0] in ("import", "upgrade", "inspect --graph", "library pack", "library doc"):
        command = parts.pop(0).split()
    if isinstance(parts[0], str) and parts[0].startswith("1."):
        version = parts.pop(0)
    is_document = command != ["import"]
    text = [f"<materialx version='{version}'>"] if is_document else []
    for part in parts:
        if isinstance(part, str):
            text.append(part.replace("*", str(count)) if "geom=" not in part else part)
            continue
        for i in range(count):
            text.append(part[0].replace("####", str(1001 + i)).replace("#", str(i)).replace("^", str(i + 1)).replace("%", f"{(i + 2) % 1000:03}"))
    line = "" if "on one line" in shape[0] else "\n"
    return command, line.join(text) + ("</materialx>\n" if is_document else "")


def work(mxgen, folder, shape, count):
    """Instructions, in millions."""
    command, text = document(shape, count)
    is_gltf = command == ["import"]
    name = os.path.join(folder, f"{shape[0].replace(' ', '_')}_{count}.{'gltf' if is_gltf else 'mtlx'}".replace("'", ""))
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
    arguments = [mxgen, name] + command if command[0].startswith("-") else [mxgen] + command + [name]
    arguments += ["-o", name + ".mtlx"] if is_gltf or command[0] == "library" else []
    count, done = checks.count_instructions(*arguments, "--max-errors", "0")
    checks.check(done.returncode in (0, 1) and count, f"{shape[0]}: ends with {done.returncode}")
    return count / 1e6


def check_readers(mxgen, folder):
    """Assimp compares all corners at one place: a limit of time ends it. A node of glTF with many properties is like another one."""
    if not os.path.exists(os.path.join(os.path.dirname(mxgen), "mxgen-render")):
        checks.skip("mxgen-render is not built: no reader of meshes is tried")
        return
    look = os.path.join(folder, "look.mtlx")
    with open(look, "w", encoding="utf-8") as file:
        file.write("<materialx version='1.39'><look name='L'/></materialx>")
    node = {"name": "a", "extras": {f"p{i}": i for i in range(20000)}}
    properties = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [node]})
    corners = "v 1 0 0\nv 0 1 0\n" + "v 0 0 0\n" * 100000 + "".join(f"f {i + 3} 1 2\n" for i in range(100000))
    for name, text, expected in ("many.gltf", properties, "it has no visible geometry"), ("one_place.obj", corners, "its reader takes too long"):
        stage = os.path.join(folder, name)
        with open(stage, "w", encoding="utf-8") as file:
            file.write(text)
        run = subprocess.run([mxgen, "bind", look, "--stage", stage, "-q"], capture_output=True, text=True, check=False)
        checks.check(run.returncode == 1 and expected in run.stderr, f"{name}: {run.returncode}, {run.stderr}")


def main():
    mxgen, wanted = sys.argv[1], sys.argv[2:]
    if not checks.counts_instructions():
        checks.finish("wide")
    shapes = [shape for shape in SHAPES if not wanted or shape[0] in wanted]
    counts = (1, FEW, FACTOR * FEW)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = {(shape[0], count): pool.submit(work, mxgen, folder, shape, count) for shape in shapes for count in counts}
        for shape in shapes:
            none, few, many = (jobs[shape[0], count].result() for count in counts)
            ratio = (many - none) / (few - none)
            checks.check(ratio < MOST, f"{shape[0]}: {few:.1f} M instructions for {FEW}, {many:.1f} M for {FACTOR * FEW}: {ratio:.1f} times")
        if not wanted:
            check_readers(mxgen, folder)
    checks.finish("wide")


main()
