#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the C source of the extension module from the public headers. Arguments: the headers, in the order of use; the output.

The declarations of the library stand in its headers only. Each member of a struct and each parameter that is a pointer to a function
also becomes a function `callback_<name>` that Python can implement."""
import pathlib
import re
import sys

import cffi

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
CPLUSPLUS = re.compile(r"^#ifdef __cplusplus\n.*?^#endif$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"^#define (MXG_\w+) (?:\d+|0x[0-9a-f]+u)$", re.MULTILINE)
DIRECTIVE = re.compile(r"^#(?:[^\n]*\\\n)*[^\n]*$", re.MULTILINE)
CALLBACK = re.compile(r"^ +(\w+) \(\*(\w+)\)\(([^)]*)\)[;,]", re.MULTILINE)


def read_declarations(path):
    """The declarations of a header, without comments and the preprocessor."""
    text = CPLUSPLUS.sub("", COMMENT.sub("", path.read_text(encoding="utf-8")))
    constants = "".join(f"#define {name} ...\n" for name in NUMBER.findall(text))
    return constants + DIRECTIVE.sub("", text).replace("MXG_API ", "")


def main(headers, output):
    declarations = "\n".join(read_declarations(pathlib.Path(header)) for header in headers)
    found = {f"{result} callback_{name}({' '.join(parameters.split())});\n" for result, name, parameters in CALLBACK.findall(declarations)}
    callbacks = "".join(sorted(found)) # two parameters of one name and type share a function
    ffi = cffi.FFI()
    ffi.cdef(declarations)
    ffi.cdef(f'extern "Python" {{\n{callbacks}}}\n')
    ffi.set_source("mxgen._native", "#include <mxgen/mxgen.h>")
    ffi.emit_c_code(output)


main(sys.argv[1:-1], sys.argv[-1])
