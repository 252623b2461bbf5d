// SPDX-License-Identifier: Apache-2.0
// The compiler of the preview, in a worker, so that the preview answers while it works.

import { serve } from "@web/serve.js";
import { distinct, placesOf, shaderOf, type Parts } from "@web/shaders.js";
import type { CompiledModule, Context, Diagnostic, Document, Element, Library, Renderable } from "mxgen";
import { DocumentError, instantiate } from "mxgen";

import type { LibraryFile } from "../src/files";
import { loadLibraries, resolve } from "../src/library";
import type { Place, Position } from "../src/messages";
import { edgesOf, elementAt, matters, type Link } from "./documents";

/** A document and what reading it tells. */
interface Reading {
    name: string;
    text: string;
    document: Document | null;
    diagnostics: Diagnostic[];
    missing: string[]; // files that it names and that nobody gave
}

export interface Compilation {
    renderables: Renderable[];
    /** the path of the element that is drawn; null: there is none */
    element: string | null;
    /** the path of the node at the cursor; null: there is none */
    node: string | null;
    shader: Parts | null;
    diagnostics: Diagnostic[];
    missing: string[];
    /** where the nodes of the inputs and textures stand, by their paths */
    places: Record<string, Place>;
}

export interface Graph {
    nodes: { path: string; category: string; type: string; place: Place | null; inputs: string[] }[];
    links: Link[];
}

export interface Source {
    text: string;
    /** for each line the place of the authored node that produced it, as an index into `nodes`; -1: none */
    lines: number[];
    nodes: { path: string; place: Place }[];
    fault: boolean;
}

const files = new Map<string, Uint8Array>();
let context: Context, library: Library | null = null, reading: Reading | null = null;
const missing = new Set<string>(); // of the text that is read

function forget(): void {
    reading?.document?.destroy();
    reading = null;
}

function open(name: string, text: string): Reading {
    if (reading?.name === name && reading.text === text)
        return reading;
    const made: Reading = { name, text, document: null, diagnostics: [], missing: [] };
    forget();
    missing.clear();
    try {
        made.document = context.parse(text, { name, library });
        made.diagnostics = [...made.document.diagnostics];
    } catch (error) {
        if (!(error instanceof DocumentError))
            throw error;
        made.diagnostics = [...error.diagnostics];
        made.document = error.document;
    }
    made.missing = [...missing];
    return reading = made;
}

function find(from: string, ref: string): { name: string; data: Uint8Array } | null {
    const name = resolve(from, ref), data = name === null ? undefined : files.get(name);
    if (name === null)
        return null;
    if (!data)
        missing.add(name);
    return data?.length ? { name, data } : null; // of length 0: the editor has none
}

/** The first element that can be drawn, with its shader. Faults of the others are of no interest, unless all are faulty. */
function draw(document: Document, paths: string[], found: Diagnostic[]): { element: string | null; shader: Parts | null } {
    for (const element of paths) {
        const faults: Diagnostic[] = [], shader = shaderOf(document, element, faults);
        if (shader || element === paths.at(-1)) {
            found.push(...faults);
            return { element, shader };
        }
    }
    return { element: null, shader: null };
}

/** Elements that may be drawn for an element, the nearest first: itself, an output of it, what is around it. */
function candidates(element: Element | null): string[] {
    const paths: string[] = [];
    for (let at = element; at?.path; at = at.parent)
        paths.push(at.path, ...at.outputs.slice(0, 1).map(({ path }) => path));
    return paths;
}

/** The material that an element belongs to: the first whose graph has it; without one the element itself. */
function wholeOf(document: Document, path: string): Element | null {
    const element = document.find(path);
    for (const renderable of document.renderables) {
        const root = document.find(renderable.path);
        if (element && root && (root.equals(element) || root.upstream.some(one => one.equals(element))))
            return root;
    }
    return element;
}

function sourceOf(document: Document, element: string, target: string): Source {
    const shader = document.generate(target, { element }), source: Source = { text: shader.pixel ?? shader.vertex ?? "", lines: [], nodes: [], fault: false };
    const stage = shader.pixel === null ? "vertex" : "pixel", known = new Map<string, number>();
    const numberOf = (path: string) => {
        let authored = document.find(path), rest = path;
        while (!authored && rest.includes("/")) {
            rest = rest.slice(0, rest.lastIndexOf("/"));
            authored = document.find(rest);
        }
        const place = authored?.place;
        return authored && place ? source.nodes.push({ path: authored.path, place }) - 1 : -1;
    };
    const count = source.text.split("\n").length;
    for (let line = 1; line <= count; line++) {
        const path = shader.sourcePath(stage, line);
        if (path !== null && !known.has(path))
            known.set(path, numberOf(path));
        source.lines.push(path === null ? -1 : known.get(path)!);
    }
    shader.destroy();
    return source;
}

serve({
    async begin({ module }: { module: CompiledModule }) {
        const mxgen = await instantiate(module);
        context = mxgen.createContext({ resolver: find });
        return mxgen.targets.map(({ name }) => name);
    },

    /** Content of length 0: there is no such file. */
    addFile({ name, content }: { name: string; content: Uint8Array }) {
        files.set(name, content);
        forget();
    },

    /** Throws DocumentError; then only the library that is built in counts. */
    libraries({ added }: { added: LibraryFile[] }) {
        forget();
        library = null;
        for (const [name, content] of added)
            files.set(name, content);
        library = loadLibraries(context, added.map(([name]) => name));
    },

    /** The shader of an element of a document, or of what is at the cursor. */
    compile({ name, text, element, cursor }: { name: string; text: string; element: string | null; cursor: Position }): Compilation {
        const { document, missing, ...read } = open(name, text), diagnostics = [...read.diagnostics];
        const none: Compilation = { renderables: [], element: null, node: null, shader: null, diagnostics, missing, places: {} };
        if (!document)
            return none;
        const { renderables } = document, node = elementAt(document, name, cursor), pinned = element === null ? null : document.find(element);
        const paths = [...candidates(pinned ?? node), ...renderables.map(({ path }) => path).slice(0, 1)];
        const drawn = draw(document, paths, diagnostics);
        return { ...none, ...drawn, renderables, node: node?.path ?? null, diagnostics: distinct(diagnostics), places: drawn.shader ? placesOf(document, drawn.shader) : {} };
    },

    /** The node at the cursor. */
    locate({ name, text, cursor }: { name: string; text: string; cursor: Position }): string | null {
        const { document } = open(name, text);
        return document && (elementAt(document, name, cursor)?.path ?? null);
    },

    inspect({ name, text, element, target }: { name: string; text: string; element: string; target: string }): Source {
        const { document } = open(name, text), nothing = { lines: [], nodes: [], fault: true };
        try {
            return document ? sourceOf(document, element, target) : { text: "", ...nothing };
        } catch (error) {
            if (!(error instanceof DocumentError))
                throw error;
            return { text: error.message, ...nothing };
        }
    },

    /** The nodes that a material depends on, and itself. */
    graph({ name, text, element }: { name: string; text: string; element: string }): Graph {
        const { document } = open(name, text), root = document && wholeOf(document, element);
        if (!root)
            return { nodes: [], links: [] };
        const elements = [root, ...root.upstream].filter(matters), links = edgesOf(root);
        return {
            nodes: elements.map(one => ({ path: one.path, category: one.category, type: one.type, place: one.place,
                inputs: [...new Set(links.filter(({ to }) => to === one.path).map(({ input }) => input))] })),
            links,
        };
    },
});
