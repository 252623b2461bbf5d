// SPDX-License-Identifier: Apache-2.0
// The language server (docs/lsp.md): messages of the Language Server Protocol as objects.

import { Host, LIMITS, newContextDesc, refusalOf } from "./context.js";
import { ArgumentError } from "./errors.js";
import { Library } from "./library.js";
import { expect, expectOptions, Handle, Owner } from "./native.js";

const OPTIONS = [...LIMITS, "send", "library", "messagesUrl", "readFile", "listFolder", "warnings", "trust", "sourcePaths", "includeRoots"];
const CHANGED_FILES = "workspace/didChangeWatchedFiles";
const REFRESHING = ["textDocument/didOpen", "textDocument/didSave", CHANGED_FILES]; // files may have changed before them
const encoder = new TextEncoder(), decoder = new TextDecoder();

/** `host` is the number of the callbacks. */
function makeSession(native, library, options, host) {
    return native.using(() => native.keeping(free => {
        const desc = newContextDesc(native, options), url = native.newOptionalText(options.messagesUrl, "messagesUrl");
        const session = native.lib.mxgen_js_lsp_create(desc, library._pointer, url);
        if (!session)
            throw new ArgumentError(refusalOf(native, desc) || "an option has a value that it cannot have");
        return new Handle(session, pointer => {
            native.lib.mxgen_js_lsp_destroy(pointer);
            native.removeHost(host);
            free();
        }, [library._handle]);
    }));
}

/** The answer of a callback with a promise for a path, for C, which cannot wait: null, until `fetch` has asked for what was missing. */
class Cache {
    #ask;
    #known = new Map();
    #missing = new Set();

    constructor(ask) {
        this.#ask = ask;
    }

    get(path) {
        if (!this.#known.has(path))
            this.#missing.add(path);
        return this.#known.get(path) ?? null;
    }

    get isComplete() {
        return this.#missing.size === 0;
    }

    async fetch() {
        const paths = [...this.#missing];
        this.#missing.clear();
        await Promise.all(paths.map(async path => this.#known.set(path, await this.#ask(path))));
    }

    clear() {
        this.#known.clear();
    }
}

/** A session with one client. */
export class LanguageServer extends Owner {
    #host;
    #number; // of the host
    #send;
    #caches;
    #messages = []; // that wait
    #turn = null; // the promise that ends when nothing waits

    constructor(native, library, options) {
        expectOptions(options, OPTIONS);
        expect(library, Library, "library");
        const { send, readFile = () => null, listFolder = () => null } = options;
        for (const [name, callback] of Object.entries({ send, readFile, listFolder }))
            expect(callback, "function", name);
        const files = new Cache(readFile), folders = new Cache(listFolder);
        const host = new Host(native, { resolver: (_, path) => files.get(path), listFolder: (_, path) => folders.get(path) }), number = native.addHost(host);
        try {
            super(native, makeSession(native, library, options, number), "language server");
        } catch (error) {
            native.removeHost(number);
            throw error;
        }
        this.#host = host;
        this.#number = number;
        this.#send = send;
        this.#caches = [files, folders];
    }

    /** Takes a message of the client. Returns a promise that ends when nothing waits: no message, and no check of a document. */
    handle(message) {
        this.#messages.push(typeof message === "string" ? message : JSON.stringify(message));
        return this.#turn ??= this.#run().finally(() => this.#turn = null);
    }

    /** A check begins when no message waits, also in the queue of the host. */
    async #run() {
        for (let works = true; works || this.#messages.length;) {
            if (!this.#messages.length)
                await new Promise(resolve => setTimeout(resolve));
            if (this._isDestroyed)
                return;
            if (this.#messages.length)
                await this.#answer(this.#messages.shift());
            else
                works = await this.#complete(() => this.#work(), true);
        }
    }

    async #answer(text) {
        const { id, method } = read(text);
        if (REFRESHING.includes(method))
            this.#caches.forEach(cache => cache.clear());
        let isRepeated = false;
        await this.#complete(() => {
            if (isRepeated) // the files are there now, and an answer may wait for the first check of a document
                this.#tell(this.#work());
            isRepeated = true;
            return this.#take(text);
        }, id !== undefined);
    }

    /** Repeats a call, if that is possible, with the files that it lacked; sends its messages. */
    async #complete(call, canRepeat) {
        for (;;) {
            const called = call(), isComplete = this.#caches.every(cache => cache.isComplete);
            if (isComplete || !canRepeat)
                this.#tell(called);
            if (isComplete)
                return called.status !== 0;
            await Promise.all(this.#caches.map(cache => cache.fetch()));
            if (this._isDestroyed)
                return false;
            this.#take(JSON.stringify({ jsonrpc: "2.0", method: CHANGED_FILES, params: { changes: [] } })); // checks anew
            if (!canRepeat)
                return true;
        }
    }

    #tell({ pieces }) {
        pieces.forEach(piece => this.#send(JSON.parse(decoder.decode(piece))));
    }

    #take(text) {
        const native = this._native, bytes = encoder.encode(text);
        return native.using(() => this.#call("mxgen_js_lsp_handle", native.newBytes(bytes), bytes.length));
    }

    #work() {
        return this.#call("mxgen_js_lsp_work");
    }

    #call(name, ...values) {
        const called = this._native.written(() => this._native.lib[name](this._pointer, this.#number, ...values));
        this.#host.check();
        return called;
    }
}

/** The server tells what is wrong with a text that is no message. */
function read(text) {
    try {
        return Object(JSON.parse(text));
    } catch {
        return {};
    }
}
