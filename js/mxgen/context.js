// SPDX-License-Identifier: Apache-2.0
// Contexts: where files come from, the limits, and the start of every other object.

import { Diagnostics } from "./diagnostics.js";
import { Document } from "./document.js";
import { Edit } from "./edit.js";
import { ArgumentError, DocumentError, MxgenError, OutOfMemoryError } from "./errors.js";
import { Library } from "./library.js";
import { expect, expectCount, expectOptions, Handle, kindOf, numberOf, Owner, readOptions, STATUS } from "./native.js";
import { Scene } from "./scene.js";
import { Shader, withOptions } from "./shader.js";

export const LIMITS = ["maxMemory", "maxFileMib", "maxElements", "maxNodes", "maxOutputMib", "maxErrors", "maxDepth", "maxIncludeDepth", "maxIncludes"];
const OPTIONS = [...LIMITS, "resolver", "listFolder", "cancel", "readTexels", "warnings", "trust", "sourcePaths"];

function bytesOf(data, what) {
    if (typeof data === "string")
        return new TextEncoder().encode(data);
    if (data instanceof ArrayBuffer)
        return new Uint8Array(data);
    if (ArrayBuffer.isView(data))
        return new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
    throw new TypeError(`${what} must be a string, ArrayBuffer or a view of one, not ${kindOf(data)}`);
}

/** The callbacks of a context, as C calls them. An exception in a callback waits until the call of C returns. */
export class Host {
    #native;
    #lent = new Map(); // addresses to free, by the handle of a blob
    #next = 1;

    constructor(native, { resolver = null, listFolder = null, cancel = null, readTexels = null }) {
        for (const [name, callback] of Object.entries({ resolver, listFolder, cancel, readTexels }))
            if (callback !== null)
                expect(callback, "function", name);
        this.#native = native;
        this.resolver = resolver;
        this.lister = listFolder;
        this.canceller = cancel;
        this.texelReader = readTexels;
        this.raised = null; // { error } of a callback
    }

    #guard(fault, work) {
        if (this.raised)
            return fault;
        try {
            return work();
        } catch (error) {
            this.raised = { error };
            return fault;
        }
    }

    open(from, ref, blob) {
        return this.#guard(0, () => {
            const native = this.#native, found = this.resolver?.(native.text(from), native.text(ref)) ?? null;
            if (found === null)
                return 0;
            const isFile = typeof found === "object" && "data" in found;
            const bytes = bytesOf(isFile ? found.data : found, "the answer of the resolver");
            const name = isFile && found.name !== undefined ? new TextEncoder().encode(expect(found.name, "string", "the name of a file") + "\0") : null;
            const size = bytes.length, data = native.allocate(size + (name?.length ?? 0));
            native.bytes(data, size).set(bytes);
            if (name)
                native.bytes(data + size, name.length).set(name);
            this.#lent.set(this.#next, data);
            native.setMembers("mxg_blob", blob, { data, size, name: name ? data + size : 0, handle: this.#next++ });
            return 1;
        });
    }

    release(blob) {
        const { handle } = this.#native.members("mxg_blob", blob);
        this.#native.lib.free(this.#lent.get(handle));
        this.#lent.delete(handle);
    }

    listFolder(from, folder, names, capacity) {
        return this.#guard(0, () => {
            const listed = this.lister(this.#native.text(from), this.#native.text(folder)) ?? [];
            if (typeof listed === "string" || typeof listed[Symbol.iterator] !== "function")
                throw new TypeError(`listFolder must return names, not ${kindOf(listed)}`);
            const bytes = new TextEncoder().encode(Array.from(listed, name => expect(name, "string", "a name of listFolder") + "\0").join(""));
            if (bytes.length <= capacity)
                this.#native.bytes(names, bytes.length).set(bytes);
            return bytes.length;
        });
    }

    readTexels(from, file, layer, size, texels) {
        return this.#guard(0, () => {
            const native = this.#native, read = this.texelReader(native.text(from), native.text(file), native.text(layer), size) ?? null;
            if (read === null)
                return 0;
            if (read.length !== 4 * size * size)
                throw new TypeError(`readTexels must return ${4 * size * size} numbers, not ${read.length ?? kindOf(read)}`);
            new Float32Array(native.view.buffer, texels, read.length).set(read);
            return 1;
        });
    }

    cancel() {
        return this.#guard(1, () => this.canceller() ? 1 : 0);
    }

    /** Throws the exception of a callback, after the call of C. */
    check() {
        const { raised } = this;
        this.raised = null;
        if (raised)
            throw raised.error;
    }
}

/**
 * Loads documents and libraries. An exception in a callback ends the call and leaves it unchanged. A callback cannot use its own context.
 * index.d.ts describes the options.
 */
export class Context extends Owner {
    #host;
    #busy = false;
    #library = null;

    constructor(native, options, defaults) {
        expectOptions(options, OPTIONS);
        const used = options.resolver ? options : { ...options, ...defaults };
        if (used.listFolder && !used.resolver)
            throw new ArgumentError("listFolder needs a resolver");
        const host = new Host(native, used), number = native.addHost(host);
        try {
            super(native, makeContext(native, used, number), "context");
        } catch (error) {
            native.removeHost(number);
            throw error;
        }
        this.#host = host;
    }

    // ---- Calls ----

    /** Calls C with the context's address. Afterwards throws the exception of a callback. */
    _turn(work) {
        const pointer = this._pointer;
        if (this.#busy)
            throw new MxgenError("a callback cannot use its own context; make another context");
        this.#busy = true;
        let result;
        try {
            result = work(pointer);
        } finally {
            this.#busy = false;
        }
        this.#host.check();
        return result;
    }

    /** Calls a function that makes an object: with the context and the arguments, which get a place for the object. */
    _make(name, destroy, parents, argumentsWith) {
        const native = this._native, { lib } = native;
        return native.using(() => {
            const out = native.space(4);
            let handle = null, status;
            try {
                status = this._turn(pointer => lib[name](pointer, ...argumentsWith(out)));
            } finally {
                if (native.pointer(out))
                    handle = new Handle(native.pointer(out), lib[destroy], [this._handle, ...parents]);
                if (status === undefined)
                    handle?.release();
            }
            if (status !== STATUS.ok && status !== STATUS.errorDocument) {
                handle?.release();
                throw native.errorOf(status);
            }
            if (!handle)
                throw new OutOfMemoryError("there is no memory for the result");
            return { handle, status };
        });
    }

    // ---- Libraries ----

    /** The library that is built in. */
    get library() {
        if (!this.#library) {
            const { lib } = this._native, made = this._turn(pointer => lib.mxg_library_builtin(pointer));
            if (!made)
                throw new OutOfMemoryError("there is no memory for the library");
            this.#library = new Library(this._native, new Handle(made, lib.mxg_library_unref, [this._handle]));
        }
        return this.#library;
    }

    /**
     * Makes a library of files or an image (.mxlib), on top of `base` (null: the built-in library). `standalone`: on top of nothing; an
     * image needs it. Throws DocumentError.
     */
    loadLibrary(paths, request = {}) {
        const { base, standalone } = readOptions(request, { base: null, standalone: false });
        if (base && standalone)
            throw new ArgumentError("a standalone library has no base");
        const native = this._native, below = standalone ? null : this.#libraryFor(base);
        const { handle, status } = native.using(() => {
            const names = native.newTexts(paths, "paths");
            return this._make("mxg_library_load", "mxg_library_unref", below ? [below._handle] : [],
                              out => [below ? below._pointer : 0, names, paths.length, out]);
        });
        const library = new Library(native, handle);
        if (status !== STATUS.ok)
            throw new DocumentError(library.diagnostics);
        return library;
    }

    #libraryFor(library) {
        return library === null ? this.library : expect(library, Library, "library");
    }

    // ---- Documents ----

    _document(library, name, argumentsWith) {
        const used = this.#libraryFor(library);
        const { handle, status } = this._make(name, "mxg_document_destroy", [used._handle], out => [used._pointer, ...argumentsWith(out)]);
        const document = new Document(this, used, handle);
        if (status !== STATUS.ok)
            throw new DocumentError(document.diagnostics, document);
        return document;
    }

    /** Reads a file by the resolver. Throws DocumentError; its `document` has the parts without errors. */
    load(path, request = {}) {
        const { library } = readOptions(request, { library: null });
        const native = this._native;
        return native.using(() => {
            const name = native.newText(path, "path");
            return this._document(library, "mxg_document_load", out => [name, out]);
        });
    }

    /** Reads a document from its text. `name` appears in messages and is the base of includes. Throws DocumentError. */
    parse(text, request = {}) {
        const { name, library } = readOptions(request, { name: "<text>", library: null });
        const native = this._native;
        return native.using(() => {
            const bytes = bytesOf(text, "text"), data = native.newBytes(bytes), called = native.newText(name, "name");
            return this._document(library, "mxg_document_parse", out => [called, data, bytes.length, out]);
        });
    }

    /**
     * Reads a file whose includes a server or a database has: `open(from, ref)` is like the resolver, and returns a promise. Files that
     * `open` does not have come from the resolver.
     */
    async loadAsync(path, open, request = {}) {
        const { library } = readOptions(request, { library: null });
        const files = new Map(), host = this.#host, { resolver } = host;
        for (;;) {
            const missing = new Map();
            host.resolver = (from, ref) => {
                const key = JSON.stringify([from, ref]), found = files.get(key);
                if (found === undefined)
                    missing.set(key, [from, ref]);
                return found ?? resolver?.(from, ref) ?? null;
            };
            let document = null, fault = null;
            try {
                document = this.load(path, { library });
            } catch (error) {
                fault = error;
            } finally {
                host.resolver = resolver;
            }
            if (!missing.size) {
                if (fault)
                    throw fault;
                return document;
            }
            document?.destroy();
            await Promise.all(Array.from(missing, async ([key, reference]) => files.set(key, await open(...reference) ?? null)));
        }
    }

    /** Begins a new document, or a changed copy of one. `library` is for a new one; a copy keeps its own. */
    edit(document = null, request = {}) {
        const { name, library } = readOptions(request, { name: "<edit>", library: null });
        if (document !== null && expect(document, Document, "document") && library !== null && library !== document.library)
            throw new ArgumentError("a changed document keeps its library");
        const native = this._native, used = document ? document.library : this.#libraryFor(library);
        return native.using(() => {
            const called = native.newText(name, "name");
            const { handle } = this._make("mxg_edit_create", "mxg_edit_destroy", document ? [used._handle, document._handle] : [used._handle],
                                          out => [used._pointer, document ? document._pointer : 0, called, out]);
            return new Edit(this, used, document, handle);
        });
    }

    // ---- The deferred pipeline ----

    /**
     * The passes of the deferred pipeline that belong to no material (docs/deferred.md): [{ name, shader }] in their order, as far as the
     * options ask for them. The source of a pass is that of `shader.pixel`, a compute stage. Throws DocumentError.
     */
    passes(target, request = {}) {
        const { options } = readOptions(request, { options: null });
        const native = this._native, { lib } = native;
        return native.using(() => withOptions(this, options, made => {
            const desc = native.newStruct("mxg_generate_desc", { target: native.newText(target, "target"), options: made });
            const all = Array.from({ length: lib.mxg_catalogue_num_passes() }, (_, index) => {
                const { handle, status } = this._make("mxg_generate_pass", "mxg_result_destroy", [], out => [index, desc, out]);
                const shader = new Shader(native, handle);
                if (status === STATUS.errorDocument)
                    throw new DocumentError(shader.diagnostics);
                return { name: native.text(lib.mxg_catalogue_pass(index)), shader };
            });
            return all.filter(({ shader }) => shader.pixel !== null);
        }));
    }

    /**
     * The module with functions of the library that shaders of a target import with the option `mdl-module` (docs/mdl.md); its source is
     * `shader.pixel`. Throws DocumentError.
     */
    module(target, request = {}) {
        const { library, options } = readOptions(request, { library: null, options: null });
        const native = this._native, used = this.#libraryFor(library);
        return native.using(() => withOptions(this, options, made => {
            const desc = native.newStruct("mxg_generate_desc", { target: native.newText(target, "target"), options: made });
            const { handle, status } = this._make("mxg_generate_module", "mxg_result_destroy", [used._handle], out => [used._pointer, desc, out]);
            const shader = new Shader(native, handle);
            if (status === STATUS.errorDocument)
                throw new DocumentError(shader.diagnostics);
            return shader;
        }));
    }

    // ---- Scenes ----

    /** A scene of primitives by their paths, "/set/table", and those above them. Throws DocumentError if a path is none. */
    scene(...paths) {
        const scene = new Scene(this, this._make("mxg_scene_create", "mxg_scene_destroy", [], out => [out]).handle);
        scene.add(...paths);
        return scene;
    }

    /**
     * Reads a list with one path in each line, or a USD text layer (.usda) with its bindings. `purpose` chooses among these: "full", "preview",
     * or null for those of all purposes. Throws DocumentError.
     */
    loadScene(path, request = {}) {
        const { purpose } = readOptions(request, { purpose: null });
        const native = this._native;
        return native.using(() => {
            const name = native.newText(path, "path"), chosen = native.newOptionalText(purpose, "purpose");
            return this._readScene("mxg_scene_load", out => [name, chosen, out]);
        });
    }

    /** Reads a USD text layer from its text. `name` appears in messages, and textures are found from there. Throws DocumentError. */
    parseScene(text, request = {}) {
        const { name, purpose } = readOptions(request, { name: "<text>", purpose: null });
        const native = this._native;
        return native.using(() => {
            const bytes = bytesOf(text, "text"), data = native.newBytes(bytes);
            const called = native.newText(name, "name"), chosen = native.newOptionalText(purpose, "purpose");
            return this._readScene("mxg_scene_parse", out => [called, data, bytes.length, chosen, out]);
        });
    }

    _readScene(name, makeArguments) {
        const { handle, status } = this._make(name, "mxg_scene_destroy", [], makeArguments);
        const scene = new Scene(this, handle);
        if (status !== STATUS.ok)
            throw new DocumentError(scene.diagnostics);
        return scene;
    }

    /** The materials in a USD scene as a document. `Document.withMaterials` adds them to one. Throws DocumentError. */
    sceneMaterials(scene, request = {}) {
        const { library } = readOptions(request, { library: null });
        expect(scene, Scene, "scene");
        return this._document(library, "mxg_document_import", out => [0, scene._pointer, out]);
    }

    // ---- Texts ----

    /** Reads a document and writes it again: "format", or "upgrade" to version 1.39. `text` null: reads the file `name`. */
    rewrite(rewriting, name, text = null) {
        const native = this._native, number = numberOf("mxg_rewriting", rewriting, "rewriting");
        return native.using(() => {
            const bytes = text === null ? null : bytesOf(text, "text"), data = bytes ? native.newBytes(bytes) : 0;
            const called = native.newText(name, "name");
            const { handle, status } = this._make("mxg_rewrite", "mxg_result_destroy", [], out => [number, called, data, bytes?.length ?? 0, out]);
            const result = new Shader(native, handle), diagnostics = result.diagnostics;
            if (status !== STATUS.ok)
                throw new DocumentError(diagnostics);
            return { text: result._text(), diagnostics };
        });
    }

    /** The text of a document in one layout; comments stay. */
    format(text, request = {}) {
        const { name } = readOptions(request, { name: "<text>" });
        return this.rewrite("format", name, text).text;
    }

    /** A document of an older version as version 1.39. */
    upgrade(text, request = {}) {
        const { name } = readOptions(request, { name: "<text>" });
        return this.rewrite("upgrade", name, text);
    }
}

/** A mxg_context_desc without callbacks. */
export function newContextDesc(native, options) {
    const values = {}, { warnings = null, trust = false, sourcePaths = [], includeRoots = [] } = options;
    for (const name of LIMITS) {
        values[name] = expectCount(options[name] ?? 0, name);
    }
    return native.newStruct("mxg_context_desc", {
        ...values, trust: expect(trust, "boolean", "trust"), warnings: native.newOptionalText(warnings, "warnings"),
        sourcePaths: native.newTexts(sourcePaths, "sourcePaths"), numSourcePaths: sourcePaths.length,
        includeRoots: native.newTexts(includeRoots, "includeRoots"), numIncludeRoots: includeRoots.length });
}

/** Why a mxg_context_desc is refused; "": it is not. */
export function refusalOf(native, desc) {
    return native.sizedText((out, capacity) => native.lib.mxg_context_desc_error(desc, out, capacity));
}

function makeContext(native, options, number) {
    return native.using(() => {
        const desc = newContextDesc(native, options), out = native.space(4);
        const status = native.lib.mxgen_js_context(desc, number, Boolean(options.listFolder), Boolean(options.cancel),
            Boolean(options.readTexels), out);
        native.check(status, status === STATUS.errorArgument ? refusalOf(native, desc) : "");
        return new Handle(native.pointer(out), pointer => {
            native.lib.mxg_context_destroy(pointer);
            native.removeHost(number);
        });
    });
}
