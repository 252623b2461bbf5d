// SPDX-License-Identifier: Apache-2.0
// The entry for browsers and bundlers.

import { instantiate } from "./mxgen.js";

export * from "./mxgen.js";

/** Loads mxgen.wasm, by default from beside this file. `source` is an address, the bytes, or a compiled module. */
export async function load(source = new URL("./mxgen.wasm", import.meta.url)) {
    if (typeof source !== "string" && !(source instanceof URL))
        return instantiate(source);
    const response = await fetch(source);
    if (!response.ok)
        throw new Error(`mxgen cannot load ${source}: ${response.status} ${response.statusText}`);
    const bytes = await response.arrayBuffer();
    if (String.fromCharCode(...new Uint8Array(bytes, 0, Math.min(4, bytes.byteLength))) !== "\0asm") // servers of apps give a page in place of what is not there
        throw new Error(`mxgen cannot load ${source}: what is there is no WebAssembly. For Vite's server: optimizeDeps: { exclude: ["mxgen"] }`);
    return instantiate(bytes);
}
