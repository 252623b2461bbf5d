// SPDX-License-Identifier: Apache-2.0
/*
 * Answers requests of compile/worker.c, one program after the other. A request is the line "LENGTH LENGTH", then the sources of the vertex
 * and the pixel stage; length 0: there is no such stage. The answer is the line "LENGTH LENGTH LENGTH", then a log and the words of both
 * stages. The log has lines "STAGE ERROR LINE TEXT": ERROR is 1 for an error and 0 for a warning, LINE is 0 without a line of the source.
 *
 * The script before this one has the function compile(sources, words), which returns the log and may put SPIR-V into words.
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
    const words = [Buffer.alloc(0), Buffer.alloc(0)];
    const log = Buffer.from(await compile(sources, words));
    write(Buffer.from(`${log.length} ${words[0].length} ${words[1].length}\n`));
    for (const bytes of [log, ...words])
        write(bytes);
}
