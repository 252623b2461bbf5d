#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A stage of twice the size takes at most 2.2 times the instructions to bind, whatever it consists of: members of a collection,
collections, references, siblings, unknown_targets, properties, slots, order, networks, prims of equal names.

Arguments: mxgen, the smaller number of things."""
import pathlib
import resource
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, count_instructions, counts_instructions, finish

MXGEN, COUNT, MOST = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2]), 2.2
LOOK = """<?xml version="1.0"?><materialx version="1.39"><surface name="s" type="surfaceshader"/>
<surfacematerial name="A" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
<look name="L"><materialassign name="a" material="A" geom="/"/></look></materialx>
"""
COLLECTION = 'rel collection:c{0}:includes = [{1}]\nrel material:binding:collection:c{0} = [</r.collection:c{0}>, </M>]\n'


def each(count, line):
    return "".join(line.format(i=i, next=i + 1) for i in range(count))


def members(count):
    names = ", ".join(f"</r/p{i}>" for i in range(count))
    return 'def Xform "r"\n{\n' + COLLECTION.format("", names) + each(count, 'def Mesh "p{i}" {{}}\n') + '}\ndef Material "M" {}\n'


def collections(count):
    return 'def Xform "r"\n{\n' + "".join(COLLECTION.format(i, "</r/p>") for i in range(count)) + 'def Mesh "p" {}\n}\ndef Material "M" {}\n'


def shared_collection(count):
    """Each primitive binds the material for the members of one collection, which has them all."""
    names = ", ".join(f"</r/p{i}>" for i in range(count))
    return ('def Xform "r"\n{\n' + f"rel collection:c:includes = [{names}]\n"
            + each(count, 'def Mesh "p{i}" {{ rel material:binding:collection:b = [</r.collection:c>, </M>] }}\n') + '}\ndef Material "M" {}\n')


def look_with_collections(count):
    """Each primitive has a collection of its own, which one collection includes."""
    return (LOOK.replace('<look name="L">', each(count, '<collection name="c{i}" includegeom="/m{i}"/>\n')
                         + f'<collection name="all" includecollection="{", ".join(f"c{i}" for i in range(count))}"/>\n<look name="L">')
            .replace("</look>", each(count, '<materialassign name="a{i}" material="A" collection="c{i}" slot="s"/>\n')
                     + '<materialassign name="b" material="A" collection="all"/></look>'))


def references(count):
    return 'class "c"\n{\n' + each(count, 'def Mesh "p{i}" {{}}\n') + "}\n" + each(count, 'def "q{i}" (references = </c/p{i}>) {{}}\n')


def siblings(count):
    return each(count, 'def Mesh "m{i}" {{}}\n')


def own_collections(count):
    return siblings(count)


def unknown_targets(count):
    return each(count, 'def Mesh "m{i}" {{ rel material:binding = </X{i}> }}\n')


def properties(count):
    return 'def Mesh "m" {\n' + each(count, "float p{i} = {i}\n") + each(count, "float p{i}.timeSamples = {{ 1: {i} }}\n") + "}\n"


def slots(count):
    return 'def Mesh "m" {\n' + each(count, "rel material:slotBinding:_s{i} = </M{i}>\n") + "}\n" + each(count, 'def Material "M{i}" {{}}\n')


def order(count):
    """Names that are not in the order of their numbers, beside an order that lists others."""
    return ('(\n    defaultPrim = "m"\n)\ndef Mesh "m" { uniform token[] material:slotOrder = [' + ", ".join(f'"s{i}"' for i in range(count)) + "]\n"
            + each(count // 2, "rel material:slotBinding:_1{i:05} = </M>\nrel material:slotBinding:_1{i:05}9 = </M>\n") + '}\ndef Material "M" {}\n')


def networks(count):
    node = ('def Shader "n{i}" {{ uniform token info:id = "ND_add_color3"\n color3f inputs:in1.connect = </M/n{next}.outputs:out>\n'
            " color3f inputs:in2.connect = </M/n{next}.outputs:out> }}\n")
    return ('def Material "M" {\ntoken outputs:surface.connect = </M/s.outputs:out>\n'
            'def Shader "s" { uniform token info:id = "ND_standard_surface_surfaceshader"\n'
            " color3f inputs:base_color.connect = </M/n0.outputs:out> }\n" + each(count, node)
            + f'def Shader "n{count}" {{ uniform token info:id = "ND_add_color3" }}\n}}\ndef Mesh "m" {{ rel material:binding = </M> }}\n')


def equal_names(count):
    return each(count, 'def Mesh "m" {{ float p = {i} }}\n')


def overrides(count):
    return (each(count, 'def Mesh "m{i}" {{ rel material:slotBinding:_000:over:_x = </N{i}> }}\n')
            + each(count, 'def NodeGraph "N{i}" {{ float outputs:base = 0.5 }}\n'))


def instances(count):
    """Half of the instances have an assignment of their own (look_at_instances)."""
    ids = ", ".join(str(i + 5) for i in range(count))
    return (f'def PointInstancer "f"\n{{\nint[] protoIndices = [{", ".join(["0"] * count)}]\nint64[] ids = [{ids}]\n'
            f'point3f[] positions = [{", ".join(["(0, 0, 0)"] * count)}]\nrel prototypes = </f/tree>\ndef Mesh "tree" {{}}\n}}\n')


def look_at_instances(count):
    return LOOK.replace("<look name=\"L\">", "<look name=\"L\">" + each(count // 2, '<materialassign name="i{i}" material="A" geom="/f[{next}]"/>'))


STAGES = {make: lambda count: LOOK for make in (members, shared_collection, collections, references, siblings, unknown_targets, properties, slots,
                                                order, networks, equal_names, overrides)}
STAGES |= {own_collections: look_with_collections, instances: look_at_instances}


def write_stack(path, layers):
    """So many materials with noise over each other, which a budget has to blend."""
    parts, looks = [], []
    for i in range(layers):
        parts.append(f'<standard_surface name="S{i}" type="surfaceshader"><input name="coat" type="float" value="0.5"/>'
                     f'<input name="sheen" type="float" value="0.{i + 1}"/></standard_surface><surfacematerial name="M{i}" type="material">'
                     f'<input name="surfaceshader" type="surfaceshader" nodename="S{i}"/></surfacematerial><nodegraph name="N{i}">'
                     '<noise2d name="n" type="float"/><output name="specular_roughness" type="float" nodename="n"/></nodegraph>')
        looks.append(f'<materialassign name="a{i}" slot="{i:03}" material="M{i}" geom="/"/>'
                     f'<materialassign name="b{i}" slot="{i:03}::x" nodegraph="N{i}" geom="/"/>')
    path.write_text(f'<materialx version="1.39">{"".join(parts)}<look name="L">{"".join(looks)}</look></materialx>', encoding="utf-8")


def seconds(folder, layers):
    """The processor time of a budget by its error."""
    write_stack(folder / "stack.mtlx", layers)
    (folder / "one.txt").write_text("/a\n", encoding="utf-8")
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = subprocess.run([MXGEN, "stack.mtlx", "--stage", "one.txt", "--max-error", "100", "-o", "out"], cwd=folder, capture_output=True,
                            check=False)
    check(result.returncode == 0, f"{layers} layers: {result.stderr[-300:]}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def work(folder, text, look=LOOK):
    """Instructions, in millions."""
    (folder / "stage.usda").write_text("#usda 1.0\n" + text, encoding="utf-8")
    (folder / "look.mtlx").write_text(look, encoding="utf-8")
    outputs = ["--json", "/dev/null", "--usda", "/dev/null", "--purpose", "full"]
    count, done = count_instructions(MXGEN, "bind", folder / "look.mtlx", "--look", "L", "--stage", folder / "stage.usda", "--quiet", *outputs)
    check(count, f"no instructions are counted: {done.stderr[-500:]}")
    return count / 1e6 or 1


def main():
    if not counts_instructions():
        return
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        start = work(folder, 'def Mesh "m" {}\n')
        for make, look in STAGES.items():
            few, many = (work(folder, make(n), look(n)) - start for n in (COUNT, 2 * COUNT))
            print(f"{make.__name__}: {few:.0f} M instructions, {many / few:.2f} times as many for twice the size")
            check(many / few < MOST, f"{make.__name__}: {many / few:.2f} times the work for twice the size")
        few, many = seconds(folder, 3), seconds(folder, 6)
        print(f"budget of a stack: {few:.1f} s for 3 layers, {many:.1f} s for 6")
        check(many < 3 * few, f"a budget of 6 layers takes {many / few:.2f} times as long as one of 3")


main()
finish("bind-growth")
