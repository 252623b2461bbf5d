// SPDX-License-Identifier: Apache-2.0
// The editor's side of the language server: requests with answers, the text as it changes, and places of the protocol as offsets.

export const URI = "file:///document.mtlx";

const CAPABILITIES = {
    textDocument: {
        completion: { completionItem: { snippetSupport: true, documentationFormat: ["markdown", "plaintext"] } },
        hover: { contentFormat: ["markdown"] },
        rename: { prepareSupport: true },
        codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ["quickfix", "source"] } } },
        publishDiagnostics: { relatedInformation: true, versionSupport: true, tagSupport: { valueSet: [1, 2] } },
    },
};

/** Lines and columns from 0; columns count UTF-16 code units, as offsets of the editor do. */
export function positionOf(doc, offset) {
    const { number, from } = doc.lineAt(offset);
    return { line: number - 1, character: offset - from };
}

export function offsetAt(doc, { line, character }) {
    if (line >= doc.lines)
        return doc.length;
    const { from, to } = doc.line(line + 1);
    return Math.min(from + character, to);
}

export const rangeOf = (doc, from, to) => ({ start: positionOf(doc, from), end: positionOf(doc, to) });
export const spanOf = (doc, { start, end }) => ({ from: offsetAt(doc, start), to: offsetAt(doc, end) });
/** Edits of the protocol as changes of the editor. */
export const changesOf = (doc, edits) => edits.map(({ range, newText }) => ({ ...spanOf(doc, range), insert: newText }));

export class Client {
    #worker;
    #next = 1;
    #waiting = new Map(); // requests by their numbers
    #isOpen = false;
    version = 0; // of the text
    onDiagnostics = () => {};

    /** `worker` carries messages (compiler.js). When it was stopped, a change of the text starts the server anew. */
    constructor(worker) {
        this.#worker = worker;
        worker.onSaid = message => this.#hear(message);
        worker.onStop = () => {
            this.#isOpen = false;
            for (const { resolve } of this.#waiting.values())
                resolve(null);
            this.#waiting.clear();
        };
    }

    #hear({ id, method, params, result, error }) {
        if (method === "textDocument/publishDiagnostics" && params.uri === URI)
            this.onDiagnostics(params);
        else if (method && id !== undefined)
            this.#send({ id, result: null }); // the server wants something that this client does not have
        else if (!method && this.#waiting.has(id)) {
            const { resolve, reject } = this.#waiting.get(id);
            this.#waiting.delete(id);
            if (error)
                reject(new Error(error.message));
            else
                resolve(result);
        }
    }

    #send(message) {
        return this.#worker.ask("language", { message: { jsonrpc: "2.0", ...message } });
    }

    notify(method, params) {
        this.#send({ method, params }).catch(() => {}); // onStop has told
    }

    /** The answer to a request; null: the server has none. */
    #request(method, params) {
        const id = this.#next++;
        return new Promise((resolve, reject) => {
            this.#waiting.set(id, { resolve, reject });
            this.#send({ id, method, params }).catch(() => {});
        });
    }

    /** Asks about the document. */
    ask(method, params = {}) {
        return this.#isOpen ? this.#request(`textDocument/${method}`, { textDocument: { uri: URI }, ...params }) : Promise.resolve(null);
    }

    open(doc) {
        this.#isOpen = true;
        this.#request("initialize", { processId: null, rootUri: null, capabilities: CAPABILITIES });
        this.notify("initialized", {});
        this.notify("textDocument/didOpen", { textDocument: { uri: URI, languageId: "materialx", version: ++this.version, text: doc.toString() } });
    }

    /** Tells how the text changed: `changes` lead from `before` to `after`. */
    change(before, after, changes) {
        if (!this.#isOpen) {
            this.open(after);
            return;
        }
        const parts = []; // the last one first, so the places of the others stay
        changes.iterChanges((from, to, _from, _to, inserted) => parts.unshift({ range: rangeOf(before, from, to), text: inserted.toString() }));
        this.notify("textDocument/didChange", { textDocument: { uri: URI, version: ++this.version }, contentChanges: parts });
    }

    /** Files beside the document came or changed. */
    filesChanged() {
        if (this.#isOpen)
            this.notify("workspace/didChangeWatchedFiles", { changes: [] });
    }
}
