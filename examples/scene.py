#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the shader of each stack of a scene under a look, and lists the primitives of each. Arguments: a document, a look, a scene,
a folder."""
from __future__ import annotations

import pathlib
import sys

import mxgen


def main(path: str, look: str, stage: str, folder: str) -> int:
    context = mxgen.Context()
    try:
        document = context.load(path)
        scene = context.load_scene(stage)
        bindings = document.bind(scene, look)
        for stack in bindings.stacks:
            text = document.generate("glsl", stack).pixel or ""
            (pathlib.Path(folder) / f"{stack.name}.frag").write_text(text, encoding="utf-8")
    except mxgen.DocumentError as error:
        print(error, file=sys.stderr)
        return 1
    for primitive in scene:
        stack_of = bindings.stack(primitive)
        slots = [f"{layer.slot} {layer.material}" for layer in bindings.layers(primitive)]
        print(primitive.path, stack_of.name if stack_of else "-", ", ".join(slots))
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("usage: scene.py DOCUMENT LOOK SCENE FOLDER")
    sys.exit(main(*sys.argv[1:]))
