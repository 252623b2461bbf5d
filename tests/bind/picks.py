#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`--slots stochastic` is control flow: of all layers, only the patterns of the picked one run. The shader runs here, as Python, with patterns
that count their calls. The counter-cases are the shader that blends, and the same shader with a choice between the values of all layers in the
place of its branches: there all patterns run. Closures of layers that are alike stand in the shader once.

Argument: mxgen."""
import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from shader_python import Vec, run

MXGEN = pathlib.Path(sys.argv[1]).resolve()
MASKS = 1.0, 0.5, 0.25, 0.75, 0.5  # base first
NUMBERS = [(i + 0.5) / 64 for i in range(64)]


def write_unlit(folder, base):
    """Each layer has its own noise, by the lacunarity; the mask of the base is given."""
    lines = ['<?xml version="1.0"?><materialx version="1.39">']
    for i, mask in enumerate((base,) + MASKS[1:]):
        # a layer that is no leaf of the others' kind, and so alone
        kind = ('<surface name="s{0}" type="surfaceshader"><input name="edf" type="EDF" nodename="e{0}"/></surface>'
                '<uniform_edf name="e{0}" type="EDF"><input name="color" type="color3" nodename="c{0}"/></uniform_edf>' if i == 2 else
                '<surface_unlit name="s{0}" type="surfaceshader"><input name="emission_color" type="color3" nodename="c{0}"/></surface_unlit>')
        lines.append(f'<fractal3d name="c{i}" type="color3"><input name="lacunarity" type="float" value="{i + 2}"/></fractal3d>' + kind.format(i)
                     + f'<substance name="m{i}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s{i}"/>'
                     f'<input name="mask" type="float" value="{mask}"/></substance>')
    write_look(folder, lines, len(MASKS))


def write_lit(folder, kinds):
    """Layers of standard_surface, of as many kinds: with a coat, or with a sheen, or with neither."""
    lines = ['<?xml version="1.0"?><materialx version="1.39">']
    extra = "", '<input name="coat" type="float" value="0.5"/>', '<input name="sheen" type="float" value="0.5"/>'
    for i in range(6):
        lines.append(f'<standard_surface name="s{i}" type="surfaceshader"><input name="base" type="float" value="0.{i + 2}"/>{extra[i % kinds]}'
                     f'</standard_surface><substance name="m{i}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s{i}"/>'
                     '<input name="mask" type="float" value="0.5"/></substance>')
    write_look(folder, lines, 6)


def write_look(folder, lines, num):
    assigns = "".join(f'<materialassign slot="{i:03}" material="m{i}" geom="/"/>' for i in range(num))
    (folder / "look.mtlx").write_text("\n".join(lines + [f'<look name="L">{assigns}</look></materialx>']), encoding="utf-8")
    (folder / "stage.txt").write_text("/a\n", encoding="utf-8")


def generate(folder, mode, *options):
    subprocess.run([MXGEN, "look.mtlx", "--stage", "stage.txt", "--target", "glsl", "-q", "--slots", mode, "-o", mode, *options], cwd=folder, check=True)
    stack = json.loads((folder / mode / "bindings.json").read_text(encoding="utf-8"))["stacks"][0]
    return (folder / mode / f"{stack['program']}.frag").read_text(encoding="utf-8")


def count_patterns(source, number):
    """The calls of library functions in the main function, by name, and the output."""
    calls = collections.Counter()

    def counted(name):
        def call(*_):
            calls[name] += 1
            return Vec((0.5,) * 3)
        return call

    names = re.findall(r"^(?:float|vec\d) (\w+)\(", source, re.MULTILINE)
    output = run(source, {"true": True}, number, **{name: counted(name) for name in names})
    return sum(calls.values()), output


def with_choices(source):
    """The shader with `x = is_it ? value : x` for all layers, whose values are computed before: the bodies of all branches run."""
    head, main = source.split("void main()")
    changed = re.sub(r"\bif \(", "if (true || ", main)
    check(changed != main, "the shader has branches")
    return head + "void main()" + changed


def test_patterns(folder, base):
    write_unlit(folder, base)
    options = "--environment", "none", "--lights", "none", "--interface", "reduced"
    picked, blended = generate(folder, "stochastic", *options), generate(folder, "blend", *options)
    num_none = 0
    for number in NUMBERS:
        num, output = count_patterns(picked, number)
        check(num == round(output[3]), f"base {base}, number {number}: {num} patterns run for the alpha {output[3]}")
        num_none += num == 0
    check((num_none > 0) == (base < 1), f"base {base}: nothing is picked {num_none} times")
    num, _ = count_patterns(blended, 0.5)
    check(num == len(MASKS), f"base {base}, blend: {num} patterns run")
    num, _ = count_patterns(with_choices(picked), 0.5)
    check(num == len(MASKS), f"base {base}, choices in the place of branches: {num} patterns run, so the count would show them")


def loops_of(source):
    return len(re.findall(r"\bfor \(", source[source.index("void main()"):]))


def test_closures(folder, target_options):
    """The loops over lights and samples stand once for each kind of layer."""
    loops = {}
    for kinds in 1, 2, 3:
        write_lit(folder, kinds)
        loops[kinds] = [loops_of(generate(folder, mode, *target_options)) for mode in ("stochastic", "blend")]
    check(0 < loops[1][0] <= 3, f"{target_options}: {loops[1][0]} loops for layers of one kind")
    check(loops[1][0] < loops[2][0] < loops[3][0] <= 4 * loops[1][0], f"{target_options}: loops by kinds of layers: {loops}")


with tempfile.TemporaryDirectory() as name:
    for base in 1.0, 0.5:
        test_patterns(pathlib.Path(name), base)
    test_closures(pathlib.Path(name), ["--interface", "reduced"])
finish("bind-picks")
