// SPDX-License-Identifier: Apache-2.0
// Writes the shader of a document and lists its uniforms. Arguments: a document, a target.
import { argv, exit } from "node:process";

import { DocumentError, load } from "mxgen";

const [path, target] = argv.slice(2);
if (!path || !target) {
    console.error("usage: shader.mjs DOCUMENT TARGET");
    exit(1);
}
const mxgen = await load();
try {
    const shader = mxgen.createContext().load(path).generate(target);
    console.log(shader.pixel);
    for (const variable of shader.variables)
        if (variable.block === "publicUniforms")
            console.log(`// ${variable.path}: ${variable.type} ${variable.name}`);
} catch (error) {
    if (!(error instanceof DocumentError))
        throw error;
    console.error(error.message);
    exit(1);
}
