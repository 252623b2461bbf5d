// SPDX-License-Identifier: Apache-2.0
/*
 * Compiles Slang to SPIR-V with slang-wasm, whose module MXGEN_SLANG names, for compile/worker.c.
 */
import { pathToFileURL } from 'node:url';

console.log = console.error; // the standard output belongs to the answers
const slang = await (await import(pathToFileURL(process.env.MXGEN_SLANG))).default();
const spirv = [...slang.getCompileTargets()].find((target) => target.name === 'SPIRV').value;
const compiler = slang.createGlobalSession();

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

function compileProgram(sources, words) {
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

function compile(sources, words) {
    try {
        compileProgram(sources, words);
        return '';
    } catch (error) {
        return logOf(String(error.message ?? error)) || '1 1 0 slang failed without a message\n';
    }
}
