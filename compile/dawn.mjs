// SPDX-License-Identifier: Apache-2.0
/*
 * Validates WGSL with Dawn, for compile/compiler_process.c. MXGEN_DAWN names index.js of the package "webgpu". The null backend needs no GPU.
 */
import { pathToFileURL } from 'node:url';

console.log = console.error; // the standard output belongs to the answers
const { create } = await import(pathToFileURL(process.env.MXGEN_DAWN));
const gpu = (globalThis.gpu = create(['backend=null'])); // Dawn crashes if it is collected before its device
const device = await (await gpu.requestAdapter()).requestDevice({ requiredFeatures: ['shader-f16', 'dual-source-blending'] });

async function compile(sources) {
    let log = '';
    for (const [stage, code] of sources.entries()) {
        if (!code)
            continue;
        device.pushErrorScope('validation');
        const module = device.createShaderModule({ code });
        const info = await module.getCompilationInfo(), fault = await device.popErrorScope();
        for (const { type, lineNum, message } of info.messages)
            if (type !== 'info')
                log += `${stage} ${type === 'error' ? 1 : 0} ${lineNum} ${message.replaceAll('\n', ' ')}\n`;
        if (fault && !info.messages.some(({ type }) => type === 'error'))
            log += `${stage} 1 0 ${fault.message.replaceAll('\n', ' ')}\n`;
    }
    return log;
}
