// SPDX-License-Identifier: Apache-2.0
// Shaders for the view (view.js), made in a worker.

import { DocumentError } from "../js/mxgen/mxgen.js";

const OPTIONS = { quality: "reference" }; // as in `mxgen render`
export const REDUCED = { options: { interface: "reduced" } };

/** Plain data of a shader, from which the page draws it. */
export function partsOf({ info: { name, displaced, alpha }, vertex, pixel, variables }) {
    return { info: { name, displaced, alpha, alphaNow: alpha }, vertex, pixel, variables };
}

export function generate(document, element, options, use) {
    const shader = document.generate("essl", { element, ...options, options: { ...OPTIONS, ...options.options } });
    try {
        return use(shader);
    } finally {
        shader.destroy();
    }
}

/** The shader of an element. `options` are of generation; null: it has errors, which go to `found`. */
export function shaderOf(document, element, found, options = {}) {
    try {
        const parts = generate(document, element, { options }, shader => {
            found.push(...shader.diagnostics);
            return partsOf(shader);
        });
        // With the values of the document: most materials are opaque, although their opacity is a uniform.
        generate(document, element, { options: { ...REDUCED.options, ...options }, withoutSource: true }, ({ info: { alpha, numClosures } }) => {
            Object.assign(parts.info, { alphaNow: alpha, numClosures });
        });
        return parts;
    } catch (error) {
        if (!(error instanceof DocumentError))
            throw error;
        found.push(...error.diagnostics);
        return null;
    }
}

/** Where the nodes of the inputs and textures of a shader stand, by their paths. */
export function placesOf(document, { variables }) {
    const places = {};
    for (const { block, path } of variables) {
        const node = path.slice(0, path.lastIndexOf("/"));
        if (!["publicUniforms", "textures"].includes(block) || !node || node in places)
            continue;
        const place = document.find(node)?.place;
        if (place)
            places[node] = place;
    }
    return places;
}

/** One fault can stand in the diagnostics of the document and of the shader. */
export function distinct(diagnostics) {
    return [...new Map(diagnostics.map(item => [JSON.stringify({ ...item, parent: 0 }), item])).values()];
}
