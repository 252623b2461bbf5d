// SPDX-License-Identifier: Apache-2.0
// The compiler of the page, or its language server, in a worker, so that the page answers while it works. A message is { id, kind, … }; the
// answer has the same id. What the language server says has no id.

import { DocumentError, instantiate } from "../js/mxgen/mxgen.js";
import { moduleOf } from "./module.js";
import { serve } from "./serve.js";
import { distinct, generate, partsOf, placesOf, REDUCED, shaderOf } from "./shaders.js";

const files = new Map(); // texts that documents include, and pictures, by their last name

const nameOf = path => path.slice(path.lastIndexOf("/") + 1);

let begin; // with the letters of the module
const mxgen = new Promise(resolve => begin = resolve).then(letters => moduleOf(letters)).then(wasm => instantiate(wasm));
const context = mxgen.then(instance => instance.createContext({ resolver: (_, ref) => files.get(nameOf(ref)) ?? null }));
let server = null;

/** Calls `use` with the document of a text; diagnostics of errors go to `found`. */
async function withDocument(text, found, use) {
    const parser = await context;
    let document;
    try {
        document = parser.parse(text, { name: "document.mtlx" });
    } catch (error) {
        if (!(error instanceof DocumentError))
            throw error;
        found.push(...error.diagnostics);
        ({ document } = error);
    }
    try {
        return document && use(document);
    } finally {
        document?.destroy();
    }
}

function attempt(work, otherwise) {
    try {
        return work();
    } catch (error) {
        if (!(error instanceof DocumentError))
            throw error;
        return otherwise(error);
    }
}

serve({
    /** The answer tells that the worker runs; the compiler may not be ready. */
    started() {
        return {};
    },

    begin({ letters }) {
        begin(letters);
        return {};
    },

    async about() {
        const { version, targets } = await mxgen;
        return { version, targets: targets.map(({ name }) => name) };
    },

    /** `content` is a text, or the bytes of a picture. */
    addFile({ name, content }) {
        files.set(name, content);
        return {};
    },

    /** A shader with the values of the document in its code: it is smaller, so a driver compiles it earlier. null: the document has errors. */
    async preview({ text }) {
        const draw = document => attempt(() => generate(document, undefined, REDUCED, partsOf), () => null);
        return await withDocument(text, [], draw) ?? null;
    },

    /** The shader, diagnostics and renderables of a document. Without errors, its warnings too. */
    async compile({ text, element, options }) {
        const diagnostics = [];
        const answer = await withDocument(text, diagnostics, document => {
            const { renderables } = document, chosen = renderables.some(({ path }) => path === element) ? element : renderables[0]?.path ?? null;
            const shader = chosen === null ? null : shaderOf(document, chosen, diagnostics, options);
            diagnostics.push(...document.validate());
            return { renderables, element: chosen, shader, places: shader ? placesOf(document, shader) : {} };
        });
        return { renderables: [], element: null, shader: null, places: {}, ...answer, diagnostics: distinct(diagnostics) };
    },

    /** The source for a target, and the closures. */
    async inspect({ text, element, target }) {
        const messageOf = error => error.message;
        const answer = await withDocument(text, [], document => ({
            source: attempt(() => {
                const shader = document.generate(target, { element }), source = shader.pixel ?? shader.vertex;
                shader.destroy();
                return source;
            }, messageOf),
            closures: attempt(() => document.inspect("closures", { element }), messageOf),
        }));
        return answer ?? { source: "", closures: "" };
    },

    /** Takes a message for the language server, whose answers follow by themselves. */
    async language({ message }) {
        const instance = await mxgen;
        server ??= instance.createLanguageServer({
            send: said => postMessage({ said }),
            readFile: path => files.get(nameOf(path)) ?? null,
            listFolder: () => files.keys(),
        });
        server.handle(message);
        return {};
    },
});
