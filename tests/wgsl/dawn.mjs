// SPDX-License-Identifier: Apache-2.0
// Finds Dawn: the package "webgpu" in the folder MXGEN_DAWN, or in node_modules beside this file (npm ci).
import {existsSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

export async function loadDawn() {
    const here = dirname(fileURLToPath(import.meta.url));
    for (const folder of [process.env.MXGEN_DAWN, here]) {
        const index = folder && join(folder, 'node_modules', 'webgpu', 'index.js');
        if (index && existsSync(index))
            return import(pathToFileURL(index));
    }
    throw new Error('no Dawn: run "npm ci" in tests/wgsl, or set MXGEN_DAWN to a folder with node_modules/webgpu');
}
