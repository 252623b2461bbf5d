#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Computes shaders in MSL on the CPU, with clang and the headers beside this file: the vertex stage at the centre of each pixel, then the
pixel stage. The argument is a file of draws, and the answers go to the standard output: tests/conformance/draws.h says their form.

A pixel has no neighbours, and an image one level: draws that read derivatives or levels are skipped."""
import ctypes
import itertools
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
COMPILE = ['clang', '-x', 'c++', '-std=c++17', '-nostdinc', '-nostdinc++', '-isystem', HERE + '/include', '-DMSL_RUN', '-w', '-O0',
           '-ffp-contract=off', '-Xclang', '-cl-single-precision-constant', '-Xclang', '-fnative-half-type', '-Xclang',
           '-fallow-half-arguments-and-returns', '-fno-exceptions', '-fno-rtti', '-fPIC', '-shared']
PRELUDE = """#include <metal_stdlib>
struct Texture { const float *data; int width, height, layers, repeats, is_linear; };
static metal::msl_image image_of(const Texture &t)
{
    metal::msl_image image;
    image.data = t.data, image.w = t.width, image.h = t.height, image.layers = t.layers;
    return image;
}
static metal::sampler sampler_of(const Texture &t)
{
    metal::sampler sampler;
    sampler.linear = t.is_linear;
    sampler.wrap = t.repeats == 2 ? metal::address::mirrored_repeat : t.repeats ? metal::address::repeat : metal::address::clamp_to_edge;
    return sampler;
}
template <typename T> static T block_of(const unsigned char *bytes)
{
    T block;
    __builtin_memcpy(&block, bytes, sizeof block);
    return block;
}
"""


class Texture(ctypes.Structure):
    _fields_ = [('data', ctypes.c_char_p)] + [(name, ctypes.c_int) for name in ('width', 'height', 'layers', 'repeats', 'is_linear')]


def skipped(draw):
    if re.search(r'\b(dfdx|dfdy|fwidth)\(', draw['vertex'] + draw['pixel']):
        return 'derivatives'
    if any(texture['levels'] > 1 for texture in draw['textures']):
        return 'levels of a texture'
    return None


# ---- The program of a group: each draw has a namespace, and each stage one in it

def call(draw, entry, source, first_buffer, name):
    """The call of a stage, whose arguments are found by their numbers, and the sizes of its blocks by their positions."""
    parameters = re.search(r'\n(?:vertex|fragment) \w+ ' + entry + r'\((.*?)\)\n\{', source, re.S).group(1)
    blocks = {block['binding']: i for i, block in enumerate(draw['blocks'])}
    textures = {texture['binding']: i for i, texture in enumerate(draw['textures'])}
    arguments = []
    for parameter in parameters.split(',\n'):
        kind, number = re.search(r'\[\[(\w+)(?:\((\d+)\))?\]\]', parameter).groups()
        type_name = parameter.split()[1].rstrip('&') if kind == 'buffer' else parameter.split()[0]
        if kind == 'buffer':
            arguments.append(f'block_of<{name}::{type_name}>(blocks[{blocks[int(number) - first_buffer]}])')
        elif kind == 'texture':
            arguments.append(f'metal::{type_name}{{image_of(textures[{textures[int(number)]}])}}')
        elif kind == 'sampler':
            arguments.append(f'sampler_of(textures[{textures[int(number)]}])')
        else:
            arguments.append('input')
    return f'{name}::{entry}({", ".join(arguments)})'


def program_of(draw, index):
    vertex, pixel = draw['vertex'], draw['pixel']
    first_buffer = max((attribute['location'] + 1 for attribute in draw['attributes']), default=0)
    at = {attribute['location']: 16 * i for i, attribute in enumerate(draw['attributes'])}
    members = re.findall(r'^    \w+ (\w+) \[\[attribute\((\d+)\)\]\];$', vertex, re.M)
    loads = ''.join(f'        __builtin_memcpy(&input.{name}, vertices + {at[int(location)]}, sizeof input.{name});\n' for name, location in members)
    output = re.search(r'struct PixelOutputs \{\n    \w+ (\w+) ', pixel).group(1)
    return (f'namespace v{index} {{\n{vertex}\n}}\nnamespace p{index} {{\n{pixel}\n}}\n'
            f'extern "C" void draw_{index}(const unsigned char *vertices, const unsigned char *const *blocks, const Texture *textures, float *out)\n'
            f'{{\n    v{index}::VertexData data;\n    {{\n        v{index}::VertexInputs input{{}};\n{loads}'
            f'        data = {call(draw, "VertexMain", vertex, first_buffer, f"v{index}")};\n    }}\n'
            f'    p{index}::VertexData input;\n    static_assert(sizeof input == sizeof data, "the stages match");\n'
            f'    __builtin_memcpy(&input, &data, sizeof input);\n'
            f'    metal::float4 color = {call(draw, "FragmentMain", pixel, 0, f"p{index}")}.{output};\n'
            f'    __builtin_memcpy(out, &color, sizeof color);\n}}\n')


def build(draws, folder, name):
    source, library = f'{folder}/{name}.cpp', f'{folder}/{name}.so'
    with open(source, 'w', encoding='utf-8') as file:
        file.write(PRELUDE + ''.join(program_of(draw, i) for i, draw in enumerate(draws) if not skipped(draw)))
    result = subprocess.run(COMPILE + [source, '-lm', '-o', library], capture_output=True, text=True)
    if result.returncode:
        raise RuntimeError(next((line for line in result.stderr.split('\n') if 'error' in line), result.stderr))
    return ctypes.CDLL(library)


# ---- Values

def pixels_of(draw, function, images):
    repeats = {'clamp-to-edge': 0, 'repeat': 1, 'mirror-repeat': 2}
    blocks = (ctypes.c_char_p * (len(draw['blocks']) + 1))(*[bytes.fromhex(block['bytes']) + bytes(16) for block in draw['blocks']])
    textures = (Texture * (len(draw['textures']) + 1))()
    for i, texture in enumerate(draw['textures']):
        if texture['file'] not in images:
            with open(texture['file'], 'rb') as file:
                images[texture['file']] = file.read()
        textures[i] = Texture(images[texture['file']], texture['width'], texture['height'], texture['layers'] or 1,
                              repeats[texture['u']], texture['filter'] == 'linear')
    vertices, stride, out = bytes.fromhex(draw['vertices']), 16 * len(draw['attributes']), (ctypes.c_float * 4)()
    pixels = b''
    for point in draw['points']:
        function(vertices[point * stride:(point + 1) * stride], blocks, textures, out)
        pixels += struct.pack('<4f', *out)
    return pixels.hex()


def answer_group(draws, folder, name, images):
    try:
        library, fault = build(draws, folder, name), None
    except RuntimeError as error:
        fault = str(error)
    for i, draw in enumerate(draws):
        if skipped(draw):
            answer = {'skip': skipped(draw)}
        elif fault:
            answer = {'error': fault}
        else:
            answer = {'pixels': pixels_of(draw, library[f'draw_{i}'], images)}
        print(json.dumps(answer), flush=True)


def main():
    if not shutil.which('clang'):
        print(json.dumps({'absent': 'without clang no MSL is computed'}))
        return
    images = {}
    with open(sys.argv[1], encoding='utf-8') as file, tempfile.TemporaryDirectory() as folder:
        groups = itertools.groupby((json.loads(line) for line in file), key=lambda draw: draw['group'])
        for number, (_, draws) in enumerate(groups):
            answer_group(list(draws), folder, str(number), images)


if __name__ == '__main__':
    main()
