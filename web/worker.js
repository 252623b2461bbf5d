// SPDX-License-Identifier: Apache-2.0
// The compiler of the page, in a worker, so that the page answers while it works. A message is { id, kind, … }; the answer has the same id.

import { DocumentError, instantiate } from "../js/mxgen/mxgen.js";
import compressed from "mxgen.wasm.gz";
import { distinct, generate, partsOf, REDUCED, serve, shaderOf } from "./shaders.js";

const files = new Map(); // texts that documents include, by their last name

const nameOf = path => path.slice(path.lastIndexOf("/") + 1);

async function begin() {
    const wasm = new Response(new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip")));
    const mxgen = await instantiate(await wasm.arrayBuffer());
    const context = mxgen.createContext({ resolver: (_, ref) => files.get(nameOf(ref)) ?? null });
    return { mxgen, context };
}

const ready = begin();

/** Calls `use` with the document of a text; diagnostics of errors go to `found`. */
function withDocument(context, text, found, use) {
    let document;
    try {
        document = context.parse(text, { name: "document.mtlx" });
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

serve({
    /** The answer tells that the worker runs; the compiler may not be ready. */
    started() {
        return {};
    },

    async about() {
        const { mxgen } = await ready;
        return { version: mxgen.version, targets: mxgen.targets.map(({ name }) => name) };
    },

    addFile({ name, content }) {
        files.set(name, content);
        return {};
    },

    /** A shader with the values of the document in its code: it is smaller, so a driver compiles it earlier. null: the document has errors. */
    async preview({ text }) {
        const { context } = await ready;
        try {
            return withDocument(context, text, [], document => generate(document, undefined, REDUCED, partsOf)) ?? null;
        } catch (error) {
            if (!(error instanceof DocumentError))
                throw error;
            return null;
        }
    },

    /** The shader, diagnostics and renderables of a document. Without errors, its warnings too. */
    async compile({ text, element }) {
        const { context } = await ready, diagnostics = [];
        const answer = withDocument(context, text, diagnostics, document => {
            const { renderables } = document, chosen = renderables.some(({ path }) => path === element) ? element : renderables[0]?.path ?? null;
            const shader = chosen === null ? null : shaderOf(document, chosen, diagnostics);
            diagnostics.push(...document.validate());
            return { renderables, element: chosen, shader };
        });
        return { renderables: [], element: null, shader: null, ...answer, diagnostics: distinct(diagnostics) };
    },

    /** The source for a target, and the closures. */
    async inspect({ text, element, target }) {
        const { context } = await ready, faults = [];
        const attempt = work => {
            try {
                return work();
            } catch (error) {
                if (!(error instanceof DocumentError))
                    throw error;
                return error.message;
            }
        };
        const answer = withDocument(context, text, faults, document => ({
            source: attempt(() => {
                const shader = document.generate(target, { element }), source = shader.pixel ?? shader.vertex;
                shader.destroy();
                return source;
            }),
            closures: attempt(() => document.inspect("closures", { element })),
        }));
        return answer ?? { source: "", closures: "" };
    },

    /** The text of the document with another value of an input. */
    async setValue({ text, path, value, type }) {
        const { context } = await ready, slash = path.lastIndexOf("/");
        return withDocument(context, text, [], document => {
            const edit = document.edit(), node = edit.find(path.slice(0, slash));
            if (!node) {
                edit.cancel();
                return { text: null };
            }
            node.value(path.slice(slash + 1), value, type);
            return { text: edit.end().xml() };
        });
    },

    async format({ text }) {
        const { context } = await ready;
        return { text: context.format(text, { name: "document.mtlx" }) };
    },
});
