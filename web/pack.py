#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a file as JavaScript that a page can load from a folder, where it can read no other file: seven bits of the bytes in a letter.

Arguments: the file, the output, which calls `mxgenModule(number of bytes, letters)`; module.js reads it. A letter that a text of JavaScript
cannot have as it is, or that programs take for the end of a text, stands with the seven bits after it in a letter of two bytes, so every
letter takes eight bits for seven."""
import pathlib
import sys

BARRED = b"\0\n\r\"\\"


def sevens(data):
    """The bits of the bytes, seven at a time, the last ones with zeros behind them."""
    bits = held = 0
    for byte in data:
        held, bits = held << 8 | byte, bits + 8
        while bits >= 7:
            bits -= 7
            yield held >> bits & 127
        held &= (1 << bits) - 1
    if bits:
        yield held << 7 - bits & 127


def letters(data):
    values = sevens(data)
    for value in values:
        if value in BARRED:
            yield chr(BARRED.index(value) + 1 << 7 | next(values, 0))
        else:
            yield chr(value)


def main():
    source, output = sys.argv[1:]
    data = pathlib.Path(source).read_bytes()
    text = f'mxgenModule({len(data)},"{"".join(letters(data))}");\n'
    pathlib.Path(output).write_bytes(text.encode("utf-8"))


main()
