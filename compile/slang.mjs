// SPDX-License-Identifier: Apache-2.0
/*
 * Compiles Slang to SPIR-V with slang-wasm, whose module MXGEN_SLANG names, for compile/slang.c: one program after the other.
 * A request is the line "LENGTH LENGTH", then the sources of the vertex and the pixel stage; length 0: there is no such stage. The
 * answer is the line "LENGTH LENGTH LENGTH", then a log and the words of both stages. The log has lines "STAGE ERROR LINE TEXT":
 * ERROR is 1 for an error and 0 for a warning, LINE is 0 without a line of the source.
 */
import fs from 'node:fs';
import { pathToFileURL } from 'node:url';

console.log = console.error; // the standard output belongs to the answers
const slang = await (await import(pathToFileURL(process.env.MXGEN_SLANG))).default();
const spirv = [...slang.getCompileTargets()].find((target) => target.name === 'SPIRV').value;
const compiler = slang.createGlobalSession();

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

/* "stage1(12): error 30015: text", then lines with the source */
function logOf(text) {
    const lines = [];
    for (const [, stage, line, kind, message] of text.matchAll(/^(?:stage([01]).*?\((\d+)\): )?(?:fatal )?(error|warning)(?: \d+)?: (.*)$/gm))
        lines.push(`${stage ?? 1} ${kind === 'error' ? 1 : 0} ${line ?? 0} ${message}\n`);
    return lines.length || !text ? lines.join('') : `1 1 0 ${text.trim().replaceAll('\n', ' ')}\n`;
}

function required(object) {
    if (!object)
        throw new Error(slang.getLastError().message || 'slang failed without a message');
    return object;
}

function compile(sources, words) {
    const session = required(compiler.createSession(spirv));
    try {
        const parts = [], entries = [];
        sources.forEach((source, stage) => {
            if (!source)
                return;
            const module = required(session.loadModuleFromSource(source, `stage${stage}`, `stage${stage}`));
            parts.push(module);
            for (let i = 0; i < module.getDefinedEntryPointCount(); i++) {
                parts.push(module.getDefinedEntryPoint(i));
                entries.push(stage);
            }
        });
        const program = required(required(session.createCompositeComponentType(parts)).link());
        entries.forEach((stage, i) => {
            words[stage] = Buffer.from(required(program.getEntryPointCodeBlob(i, 0)));
        });
    } finally {
        session.delete();
    }
}

for (;;) {
    const sources = readNumbers().map((size) => read(size).toString());
    const words = [Buffer.alloc(0), Buffer.alloc(0)];
    let log = '';
    try {
        compile(sources, words);
    } catch (error) {
        log = logOf(String(error.message ?? error)) || '1 1 0 slang failed without a message\n';
    }
    const text = Buffer.from(log);
    write(Buffer.from(`${text.length} ${words[0].length} ${words[1].length}\n`));
    for (const bytes of [text, ...words])
        write(bytes);
}
