#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What each language lacks: the table of docs/hosts.md is what mxgen says of documents and options for each target. Arguments: mxgen, the
root of the sources, and --update to write the table.

A lack is told at generation: a cell is the message that a feature gets, by its id, or nothing, and a shader that is made without a word has
the feature. What goes beyond a language by its table, such as a number of textures, is one of the rows."""
import collections
import concurrent.futures
import difflib
import pathlib
import re
import subprocess
import sys
import tempfile

MXGEN, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
PAGE = ROOT / 'docs/hosts.md'
MARK, END = '<!-- lacks -->\n', '<!-- end -->'


def document(body):
    return f'<materialx version="1.39">\n{body}\n</materialx>\n'


def chain(kind, number, reader, name='sum'):
    """A sum of values, each read by a node of its own."""
    lines, last = [], 'v0'
    for i in range(number):
        lines.append(reader.format(i=i))
        if i:
            lines.append(f'<add name="s{i}" type="{kind}"><input name="in1" type="{kind}" nodename="{last}"/>'
                         f'<input name="in2" type="{kind}" nodename="v{i}"/></add>')
            last = f's{i}'
    return '\n'.join(lines) + f'\n<output name="{name}" type="{kind}" nodename="{last}"/>'


IMAGE = '<image name="v{i}" type="color3"><input name="file" type="filename" value="{i}.png"/></image>'
PROPERTY = '<geompropvalue name="v{i}" type="color4"><input name="geomprop" type="string" value="p{i}"/></geompropvalue>'
VALUE_AOV = '<aov name="a{i}" type="float"><input name="name" type="string" value="a{i}"/><input name="value" type="float" value="1"/></aov>'
GOLD = '<standard_surface name="gold" type="surfaceshader"><input name="metalness" type="float" value="1"/></standard_surface>'
SLABS = ('<slab name="metal" type="BSDF"><input name="f0" type="color3" value="0.9, 0.6, 0.3"/></slab>\n'
         '<slab_surface name="gold" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="metal"/></slab_surface>')
MATERIAL = '<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="gold"/></surfacematerial>'
HEIGHT = ('<fractal2d name="height" type="float"/>\n<heighttonormal name="slopes" type="vector3"><input name="in" type="float" nodename="height"/>'
          '</heighttonormal>\n')
STACK = HEIGHT + '<standard_surface name="S" type="surfaceshader"><input name="normal" type="vector3" nodename="slopes"/></standard_surface>'

# The feature, its document, and options.
ROWS = [(f'`--role {role}`', document(SLABS), ['--role', role]) for role in ('function', 'path', 'scatter', 'deferred', 'depth', 'payload', 'pack')] + [
    ('a second source of a blend', document(SLABS), ['--transparency', 'dual']),
    ('one layer of a stack by a number', document(SLABS), ['--slots', 'stochastic']),
    ('what lies below rough interfaces, blurred', document(SLABS), ['--rough-refraction', 'blur']),
    ('17 textures', document(chain('color3', 17, IMAGE)), []),
    ('25 vertex attributes', document(chain('color4', 25, PROPERTY)), []),
    ('an AOV', document('\n'.join([GOLD, VALUE_AOV.format(i=0), MATERIAL])), ['-e', 'M']),
    ('an AOV that the caller lists', document(GOLD), ['--aovs', 'dirt=color3']),
    ('9 outputs', document('\n'.join([GOLD] + [VALUE_AOV.format(i=i) for i in range(8)] + [MATERIAL])), ['-e', 'M']),
    ('a string of the geometry', document('<geompropvalue name="word" type="string"><input name="geomprop" type="string" value="word"/></geompropvalue>\n'
                                          '<image name="seen" type="color3"><input name="file" type="filename" nodename="word"/></image>\n'
                                          '<output name="out" type="color3" nodename="seen"/>'), []),
    ('a string as the result', document('<constant name="word" type="string"><input name="value" type="string" value="x"/></constant>\n'
                                        '<output name="out" type="string" nodename="word"/>'), ['-e', 'out']),
    ('an unsigned number in a node of source', None, []),
    ('the direction of the view in a pattern', document('<viewdirection name="view" type="vector3"/>\n<output name="out" type="vector3" nodename="view"/>'), []),
    ('slopes of a height', document(STACK), []),
    ('slopes of a height, `--role function`', document(STACK), ['--role', 'function']),
    ('slopes of a height, `--role scatter`', document(STACK), ['--role', 'scatter']),
    ('a displacement', document('<displacement name="out" type="displacementshader"><input name="displacement" type="float" value="0.1"/></displacement>\n'
                                + GOLD + MATERIAL.replace('</surf', '<input name="displacementshader" type="displacementshader" nodename="out"/></surf')), ['-e', 'M']),
    ('a volume', document('<anisotropic_vdf name="fog" type="VDF"/>\n<volume name="out" type="volumeshader"><input name="vdf" type="VDF" nodename="fog"/></volume>\n'
                          '<volumematerial name="M" type="material"><input name="volumeshader" type="volumeshader" nodename="out"/></volumematerial>'), ['-e', 'M']),
]
NODE = document('<nodedef name="ND_bits" node="bits"><input name="in" type="float" value="3"/><output name="out" type="float"/></nodedef>\n'
                '<implementation name="IM_bits" nodedef="ND_bits" file="bits.glsl" function="bits"/>\n<time name="t" type="float"/>\n'
                '<bits name="b" type="float"><input name="in" type="float" nodename="t"/></bits>\n<output name="out" type="float" nodename="b"/>')
SOURCE = 'float bits(float x)\n{\n    uint bits = uint(x) ^ 5u;\n    return float(bits >> 1u);\n}\n'


def run(arguments, folder):
    return subprocess.run([MXGEN] + arguments, cwd=folder, capture_output=True, text=True, check=False)


def option_cell(result):
    return 'no option' if 'does not apply' in result.stderr else ''


def cell_of(result):
    """The ids of the messages, as errors or warnings."""
    if option_cell(result):
        return option_cell(result)
    told = re.findall(r'^(?:\S+: )?(error|warning): [^\n]*\[([\w-]+)\]$', result.stderr, re.M)
    assert result.returncode in (0, 1) and (result.returncode == 0) == all(kind == 'warning' for kind, _ in told), result.stderr
    return ', '.join(dict.fromkeys(f'`{name}`' if kind == 'error' else f'({name})' for kind, name in told))


def options_of(folder):
    """The options of generation, with a value for each."""
    text = run(['--help', 'all'], folder).stdout
    text = text[text.index('Options of generation'):]
    found = re.findall(r'^      --([\w-]+) ?(\S*)', text, re.M)
    return [['--' + key] + (['1' if value == 'N' else value.split('|')[0]] if value else []) for key, value in found]


def table(head, rows):
    return ''.join('| ' + ' | '.join(cells) + ' |\n' for cells in [head, ['---'] * len(head), *rows])


def main():
    told = run(['none.mtlx', '--target', 'none'], '/').stderr
    targets = re.search(r'expected one of: (.*) \[', told).group(1).split(', ')
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / 'bits.glsl').write_text(SOURCE)
        for i, (_, text, _) in enumerate(ROWS):
            (folder / f'{i}.mtlx').write_text(text or NODE)
        (folder / 'gold.mtlx').write_text(document(SLABS))
        rows = [(feature, [f'{i}.mtlx'] + options) for i, (feature, _, options) in enumerate(ROWS)]
        options = [(f'`{option[0]}`', ['gold.mtlx'] + option) for option in options_of(folder)]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            def cells(rows, cell):
                return pool.map(lambda row: [cell(run(row[1] + ['--target', target, '--stdout', '-W', 'no-missing-texture'], folder)) for target in targets], rows)
            features = [(row[0], *told) for row, told in zip(rows, cells(rows, cell_of))]
            having = collections.defaultdict(list)
            for row, told in zip(options, cells(options, option_cell)):
                having[tuple(target for target, cell in zip(targets, told) if not cell)].append(row[0])
    tables = table(['', *(f'`{target}`' for target in targets)], features) + '\n' + table(
        ['options', 'only in'], [(', '.join(keys), ', '.join(has)) for has, keys in having.items() if len(has) < len(targets)])
    page = PAGE.read_text(encoding='utf-8')
    before, rest = page.split(MARK)
    old, after = rest.split(END, 1)
    if '--update' in sys.argv:
        PAGE.write_text(before + MARK + tables + END + after, encoding='utf-8')
    elif old != tables:
        print('\n'.join(difflib.unified_diff(old.split('\n'), tables.split('\n'), 'docs/hosts.md', 'what mxgen says', lineterm='')))
        print('the tables of docs/hosts.md are out of date; run this test with --update')
    print(f'lacks: {int(old == tables)} passed, {int(old != tables)} failed')
    sys.exit(old != tables and '--update' not in sys.argv)


main()
