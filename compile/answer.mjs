// SPDX-License-Identifier: Apache-2.0
/*
 * Answers requests of compile/compiler_process.c, one program after the other. A request is the line "LENGTH LENGTH", then the sources of the vertex
 * and the pixel stage; length 0: there is no such stage. The answer is the line "LENGTH LENGTH LENGTH LENGTH", then a log, the words of both
 * stages, and the places of variables (compile/compile.h) that the compiler chose.
 *
 * The log has lines "STAGE ERROR LINE TEXT": ERROR is 1 for an error and 0 for a warning, LINE is 0 without a line of the source. Places
 * have lines "SET INDEX OFFSET SIZE STRIDE NAME".
 *
 * The script before this one has the function compile(sources, out), which returns the log and may set out.words, SPIR-V of both stages,
 * and out.places.
 */
import fs from 'node:fs';

let input = Buffer.alloc(0);
function readMore() {
    const chunk = Buffer.alloc(1 << 16);
    const size = fs.readSync(0, chunk, 0, chunk.length, null);
    if (size === 0)
        process.exit(0);
    input = Buffer.concat([input, chunk.subarray(0, size)]);
}
function read(size) {
    while (input.length < size)
        readMore();
    const bytes = input.subarray(0, size);
    input = input.subarray(size);
    return bytes;
}
function readNumbers() {
    while (!input.includes(10))
        readMore();
    return read(input.indexOf(10) + 1).toString().trim().split(' ').map(Number);
}
function write(bytes) {
    for (let done = 0; done < bytes.length;)
        done += fs.writeSync(1, bytes, done);
}

for (;;) {
    const sources = readNumbers().map((size) => read(size).toString());
    const out = { words: [Buffer.alloc(0), Buffer.alloc(0)], places: '' };
    const log = await compile(sources, out);
    const parts = [Buffer.from(log), ...out.words, Buffer.from(out.places)];
    write(Buffer.from(`${parts.map(({ length }) => length).join(' ')}\n`));
    parts.forEach(write);
}
