// SPDX-License-Identifier: Apache-2.0
// Elements by their places, and connections between them.

import type { Document, Element } from "mxgen";

import type { Position } from "../src/messages";

/** A connection: `to` reads its `input` from `from`. */
export interface Link {
    from: string;
    to: string;
    input: string;
}

/** Elements that belong to the one around them. */
const PARTS = new Set(["input", "token", "property", "comment", "bind", "ui"]);

export const matters = (element: Element) => !PARTS.has(element.category);

/** The last element below `parent` that begins at or before a place of a file. */
function lastBefore(parent: Element, file: string, { line, column }: Position): Element | null {
    let found: Element | null = null;
    for (const child of parent) {
        const { place } = child;
        if (!place || place.file !== file)
            continue;
        if (place.line > line || (place.line === line && place.column > column))
            break;
        found = child;
    }
    return found;
}

/** The node, graph, output or material that a place is in or behind; null: there is none before it. */
export function elementAt(document: Document, file: string, cursor: Position): Element | null {
    let found: Element | null = null;
    for (let at = lastBefore(document.root, file, cursor); at && matters(at); at = lastBefore(at, file, cursor))
        found = at;
    return found;
}

/** The connections that an element depends on. Those of an output of a graph are those of the graph. */
export function edgesOf(root: Element): Link[] {
    return root.edges.filter(({ upstream }) => matters(upstream)).map(({ element, input, upstream }) => (
        { from: upstream.path, to: element.path || root.path, input: input.name }));
}
