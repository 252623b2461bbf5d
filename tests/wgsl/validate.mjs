// SPDX-License-Identifier: Apache-2.0
// Compiles modules of WGSL with Dawn, whose null backend needs no GPU. Arguments: files and folders. Prints "FILE:LINE:COLUMN: message"
// for what Dawn refuses, and "N modules, M refused"; the exit status is 1 if there is one.
//
// Dawn is the package "webgpu" (package-lock.json), in MXGEN_DAWN or beside this file.
import {readFileSync, readdirSync, statSync} from 'node:fs';
import {join} from 'node:path';
import {loadDawn} from './dawn.mjs';

function* modulesOf(path) {
    if (!statSync(path).isDirectory())
        yield path;
    else
        for (const name of readdirSync(path).sort())
            if (statSync(join(path, name)).isDirectory() || name.endsWith('.wgsl'))
                yield* modulesOf(join(path, name));
}

const {create} = await loadDawn();
const gpu = globalThis.gpu = create(['backend=null']); // Dawn crashes if it is collected before its device
const device = await (await gpu.requestAdapter()).requestDevice();
let modules = 0, refused = 0;
for (const path of process.argv.slice(2).flatMap(argument => [...modulesOf(argument)])) {
    device.pushErrorScope('validation');
    device.createShaderModule({code: readFileSync(path, 'utf8')});
    const error = await device.popErrorScope();
    if (error)
        console.log(`${path}${error.message.replace('Error while parsing WGSL: ', '').split('\n\n')[0]}`);
    modules++;
    refused += error ? 1 : 0;
}
console.log(`${modules} modules, ${refused} refused`);
device.destroy();
process.exitCode = refused || !modules ? 1 : 0;
