#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the shader of a document and lists its uniforms. Arguments: a document, a target."""
from __future__ import annotations

import sys

import mxgen


def main(path: str, target: str) -> int:
    try:
        shader = mxgen.Context().load(path).generate(target)
    except mxgen.DocumentError as error:
        print(error, file=sys.stderr)
        return 1
    print(shader.pixel)
    for variable in shader.variables:
        if variable.block == mxgen.Block.PUBLIC_UNIFORMS:
            print(f"// {variable.path}: {variable.type} {variable.name}")
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: shader.py DOCUMENT TARGET")
    sys.exit(main(sys.argv[1], sys.argv[2]))
