// SPDX-License-Identifier: Apache-2.0
// The entry for Node: contexts without a resolver read files of the file system.

import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { instantiate } from "./mxgen.js";

export * from "./mxgen.js";

/** The paths of a reference: beside the referring file, then in the working directory. */
function* placesOf(from, ref) {
    if (from.includes("/") && !path.isAbsolute(ref))
        yield path.join(path.dirname(from), ref);
    yield path.normalize(ref);
}

function isMissing(error) {
    return ["ENOENT", "ENOTDIR"].includes(error.code);
}

/** The first answer of `read` for a place that exists; null: none exists. */
function tryPlaces(from, ref, read) {
    for (const place of placesOf(from, ref)) {
        try {
            return read(place);
        } catch (error) {
            if (!isMissing(error))
                throw error;
        }
    }
    return null;
}

const files = {
    resolver: (from, ref) => tryPlaces(from, ref, name => ({ name, data: fs.readFileSync(name) })),
    listFolder: (from, folder) => tryPlaces(from, folder || ".", name => fs.readdirSync(name)),
};

/** Loads mxgen.wasm, by default from beside this file. `source` is a path, a file: address, the bytes, or a compiled module. */
export async function load(source = new URL("./mxgen.wasm", import.meta.url)) {
    const file = source instanceof URL ? fileURLToPath(source) : source;
    return instantiate(typeof file === "string" ? fs.readFileSync(file) : file, files);
}
