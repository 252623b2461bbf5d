// SPDX-License-Identifier: Apache-2.0
/*
 * Compiles Slang to SPIR-V with slang-wasm, whose module MXGEN_SLANG names, for compile/compiler_process.c. Places of variables are those of Slang's
 * reflection.
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

/* ---- Places ---- */

/* Where a parameter or member is, of its place in buffers ("uniform"), among descriptors or among the inputs of a stage. */
const placeOf = (layout, kind) => (layout.bindings ?? [layout.binding ?? {}]).find((place) => place.kind === kind) ?? {};
const slotOf = (layout) => placeOf(layout, 'descriptorTableSlot').index ?? 0;
const line = (name, { set = 0, index = 0, offset = 0, size = 0, stride = 0 }) => `${set} ${index} ${offset} ${size} ${stride} ${name}\n`;

/* A texture and its sampler have the name of their struct; "lights.color" is a member of each element of an array. */
function placesOfMember(member, set, buffer, firstSlot) {
    const { type, name } = member, { offset, size } = placeOf(member, 'uniform');
    if (type.kind === 'struct')
        return type.fields.map((part) => line(name, { set, index: firstSlot + slotOf(member) + slotOf(part) }));
    if (type.kind !== 'array')
        return [line(name, { set, index: buffer, offset, size })];
    return type.elementType.fields.map((part) => {
        const inside = placeOf(part, 'uniform');
        return line(`${name}.${part.name}`, { set, index: buffer, offset: offset + inside.offset, size: inside.size, stride: type.uniformStride });
    });
}

function placesOf({ parameters, entryPoints }) {
    const inBuffers = parameters.filter(({ type }) => type.kind === 'constantBuffer').flatMap((parameter) => {
        const { containerVarLayout: container, elementVarLayout: element } = parameter.type;
        const set = placeOf(parameter, 'descriptorTableSlot').space, slot = slotOf(parameter);
        return element.type.fields.flatMap((member) => placesOfMember(member, set, slot + slotOf(container), slot + slotOf(element)));
    });
    const attributes = entryPoints.filter(({ stage }) => stage === 'vertex').flatMap((entry) => entry.parameters)
        .filter((parameter) => parameter.binding?.kind === 'varyingInput');
    return [...inBuffers, ...attributes.map(({ name, binding }) => line(name, { index: binding.index }))].join('');
}

/* ---- Programs ---- */

function compileProgram(sources, out) {
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
            out.words[stage] = Buffer.from(required(program.getEntryPointCodeBlob(i, 0)));
        });
        out.places = placesOf(required(program.getLayout(0)).toJsonObject());
    } finally {
        session.delete();
    }
}

function compile(sources, out) {
    try {
        compileProgram(sources, out);
        return '';
    } catch (error) {
        return logOf(String(error.message ?? error)) || '1 1 0 slang failed without a message\n';
    }
}
