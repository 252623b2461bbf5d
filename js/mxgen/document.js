// SPDX-License-Identifier: Apache-2.0
// Documents and their elements.

import { Diagnostics } from "./diagnostics.js";
import { ArgumentError, DocumentError, OutOfMemoryError } from "./errors.js";
import { readNodeDef } from "./library.js";
import { expect, expectOptions, INSPECT, NONE, numberOf, Owner, readOptions, STATUS } from "./native.js";
import { Bindings, Scene } from "./scene.js";
import { Shader, withOptions } from "./shader.js";

/** An element of a document. */
export class Element {
    /** `number` is that of the C interface: a document that an edit makes keeps it. */
    constructor(document, number) {
        this.document = expect(document, Document, "document");
        this.number = expect(number, "number", "number");
        this.#info();
    }

    get #lib() {
        return this.document._native.lib;
    }

    #info() {
        const info = this.document._native.record("mxg_element_info",
                                                  out => this.#lib.mxg_document_element(this.document._pointer, this.number, out));
        if (!info)
            throw new ArgumentError(`the document has no element ${this.number}`);
        return info;
    }

    #element(number) {
        return number ? new Element(this.document, number) : null;
    }

    /** "nodegraph", "input", "standard_surface" … */
    get category() {
        return this.#info().category;
    }

    /** The name; "" if it has none. */
    get name() {
        return this.#info().name;
    }

    /** The attribute `type`; "" if absent. */
    get type() {
        return this.#info().type;
    }

    /** "NG_marble1/out"; "" for the root. */
    get path() {
        const pointer = this.document._pointer;
        return this.document._native.sizedText((out, capacity) => this.#lib.mxg_document_element_path(pointer, this.number, out, capacity));
    }

    /** Where the element begins: line and column from 1; null after an edit. */
    get place() {
        const { file, line, column } = this.#info();
        return line ? { file, line, column } : null;
    }

    // ---- The tree ----

    /** The element around it; null for the root. */
    get parent() {
        return this.#element(this.#info().parent);
    }

    /** The elements directly below. */
    get children() {
        const found = [];
        for (let child = this.#element(this.#info().firstChild); child; child = this.#element(child.#info().next))
            found.push(child);
        return found;
    }

    /** The element of a name directly below; null: there is none. */
    child(name) {
        const native = this.document._native;
        return native.using(() => {
            const path = native.newText(name, "name");
            return this.#element(name && this.#lib.mxg_document_find_element(this.document._pointer, this.number, path));
        });
    }

    /** The elements of a category directly below. */
    childrenOf(category) {
        return this.children.filter(child => child.category === category);
    }

    /** The inputs that the document writes. `definition` has those that keep their defaults, too. */
    get inputs() {
        return this.childrenOf("input");
    }

    /** The outputs of a nodegraph. */
    get outputs() {
        return this.childrenOf("output");
    }

    /** The input of a name; null: the document does not write it. */
    input(name) {
        return this.inputs.find(input => input.name === name) ?? null;
    }

    /** The elements directly below. */
    [Symbol.iterator]() {
        return this.children[Symbol.iterator]();
    }

    /** The element and all elements below, in the order of the document. */
    *walk() {
        yield this;
        for (const child of this.children)
            yield* child.walk();
    }

    // ---- Attributes ----

    /** The text of an attribute ("name" included); null if it is absent. */
    get(attribute) {
        const native = this.document._native;
        return native.using(() => {
            const name = native.newText(attribute, "attribute");
            if (attribute === "name")
                return this.name || null;
            const index = this.#lib.mxg_document_find_attribute(this.document._pointer, this.number, name);
            const found = native.record("mxg_attribute", out => this.#lib.mxg_document_attribute(this.document._pointer, this.number, index, out));
            return found && found.value;
        });
    }

    /** The attributes without the name, in the order of the document. */
    get attributes() {
        const items = this.document._native.records("mxg_attribute", this.#info().numAttributes,
            (index, out) => this.#lib.mxg_document_attribute(this.document._pointer, this.number, index, out));
        return new Map(items.map(({ name, value }) => [name, value]));
    }

    /**
     * The value of an input, output or token by its type: an array for a colour, vector or matrix; the text for other types and for a text
     * that is not a value of the type; null if it has none.
     */
    get value() {
        const value = this.document._native.record("mxg_value", out => this.#lib.mxg_document_value(this.document._pointer, this.number, out));
        if (!value)
            return null;
        const numbers = value.values.slice(0, value.numValues);
        if (!numbers.length)
            return value.text;
        if (value.type === "boolean")
            return numbers[0] !== 0;
        if (value.type === "integer")
            return value.integer;
        return numbers.length === 1 ? numbers[0] : numbers;
    }

    // ---- The graph ----

    /**
     * The connection of an input or output; null if it has none. `source` is a node or nodegraph, or the input of the nodegraph; null: the
     * document has no such element, or a definition declares the input.
     */
    get connection() {
        const native = this.document._native;
        return native.using(() => {
            const out = native.newStruct("mxg_connection"), status = this.#lib.mxg_document_connection(this.document._pointer, this.number, out);
            if (status === STATUS.errorArgument)
                return null;
            if (status !== STATUS.errorDocument) // then the source does not exist
                native.check(status);
            const { source, ...names } = native.members("mxg_connection", out);
            return { source: this.#element(source), ...names };
        });
    }

    /**
     * The connections that the element depends on, each once, the nearest first: `element` reads its `input` from `upstream`. Goes into
     * nodegraphs.
     */
    get edges() {
        const found = new Map(), ahead = [this], seen = new Set([this.number]);
        for (const element of ahead)
            for (const port of ["input", "output"].includes(element.category) ? [element] : [...element.inputs, ...element.outputs]) {
                const upstream = port.connection?.source;
                if (!upstream)
                    continue;
                if (!found.has(port.number))
                    found.set(port.number, { element: port.parent, input: port, upstream });
                if (!seen.has(upstream.number))
                    ahead.push(upstream);
                seen.add(upstream.number);
            }
        return [...found.values()];
    }

    /** The nodes and nodegraphs that the element depends on, each once, the nearest first. Goes into nodegraphs. */
    get upstream() {
        const sources = this.edges.map(({ upstream }) => upstream).filter(({ category }) => category !== "input");
        return [...new Map(sources.map(source => [source.number, source])).values()];
    }

    /** The definition of a node, or of the nodegraph that implements it; null: there is none, or it does not fit. */
    get definition() {
        const native = this.document._native;
        const index = this.#lib.mxg_document_find_nodedef(this.document._pointer, this.number) >>> 0;
        return index === NONE ? null : readNodeDef(this.document, index, "document");
    }

    /** Whether both are the same element of the same document. */
    equals(other) {
        return other instanceof Element && other.document === this.document && other.number === this.number;
    }

    toString() {
        return `<${this.category} "${this.path}">`;
    }

    [INSPECT]() {
        return this.toString();
    }
}

/** A document; immutable. `Context.load`, `Context.parse` and edits give documents. */
export class Document extends Owner {
    constructor(context, library, handle) {
        super(context._native, handle, "document");
        this.context = context;
        this.library = library;
    }

    // ---- Contents ----

    /** The diagnostics of reading it. */
    get diagnostics() {
        return new Diagnostics(this, this._native.lib.mxg_document_diagnostics(this._pointer));
    }

    /** The files of the document, itself first. */
    get files() {
        const { lib } = this._native;
        return Array.from({ length: lib.mxg_document_num_files(this._pointer) },
                          (_, index) => this._native.text(lib.mxg_document_file(this._pointer, index)));
    }

    /** <materialx>. The tree is the one that generation sees: after includes, templates and the upgrade to 1.39. */
    get root() {
        const native = this._native;
        return new Element(this, native.using(() => native.lib.mxg_document_find_element(this._pointer, 0, native.newText("", "path"))));
    }

    /** An element by path: "NG_marble1/out"; null: there is none. */
    find(path) {
        const number = this._native.using(() => this._native.lib.mxg_document_find_element(this._pointer, 0, this._native.newText(path, "path")));
        return number ? new Element(this, number) : null;
    }

    /** The elements of the root. */
    [Symbol.iterator]() {
        return this.root[Symbol.iterator]();
    }

    toString() {
        return `Document "${this.files[0]}", ${this.root.children.length} elements`;
    }

    /** All elements, in the order of the document, the root first. */
    walk() {
        return this.root.walk();
    }

    /** The materials. A document without materials has its graph outputs and the shaders that nothing uses. */
    get renderables() {
        const { lib } = this._native;
        return this._native.records("mxg_renderable", lib.mxg_document_num_renderables(this._pointer),
                                    (index, out) => lib.mxg_document_renderable(this._pointer, index, out));
    }

    /** The materials that a look or a look group assigns; empty if `look` is not the path of a look. */
    lookMaterials(look) {
        const native = this._native;
        return native.using(() => {
            const path = native.newText(look, "look");
            return this.renderables.filter((_, index) => native.lib.mxg_document_has_assignment(this._pointer, path, index));
        });
    }

    /** The definitions that the document adds to its library. */
    get nodedefs() {
        const { lib } = this._native, first = lib.mxg_library_num_nodedefs(this.library._pointer);
        return Array.from({ length: lib.mxg_document_num_nodedefs(this._pointer) - first },
                          (_, index) => readNodeDef(this, first + index, "document"));
    }

    /** The document as MaterialX XML. Reading the text gives an equal tree. */
    xml() {
        const text = this._native.text(this._native.lib.mxg_document_xml(this._pointer, 0));
        if (text === null)
            throw new OutOfMemoryError("there is no memory for the text");
        return text;
    }

    /** Begins a changed copy. */
    edit() {
        return this.context.edit(this);
    }

    // ---- Scenes ----

    /** A copy with the materials of a USD scene that the document lacks. Throws DocumentError. */
    withMaterials(scene) {
        expect(scene, Scene, "scene");
        return this.context._document(this.library, "mxg_document_import", out => [this._pointer, scene._pointer, out]);
    }

    /**
     * Finds the layers of each primitive of a scene. `look` is a look, or a look group with a default; null: the only look, or just the
     * bindings of the scene if the document has none. `solo` has the slots that alone count, `mute` those that do not. Throws DocumentError.
     * `previous` are bindings of the scene before it or the document changed: only primitives at or below a difference are resolved again.
     */
    bind(scene, look = null, request = {}) {
        const { solo, mute, previous } = readOptions(request, { solo: [], mute: [], previous: null });
        expect(scene, Scene, "scene");
        const native = this._native;
        return native.using(() => {
            const desc = native.newStruct("mxg_bindings_desc", {
                look: native.newOptionalText(look, "look"), solo: native.newTexts(solo, "solo"), numSolo: solo.length,
                mute: native.newTexts(mute, "mute"), numMute: mute.length,
                previous: previous === null ? 0 : expect(previous, Bindings, "previous")._pointer });
            const { handle, status } = this.context._make("mxg_bindings_create", "mxg_bindings_destroy", [this._handle, scene._handle],
                                                          out => [this._pointer, scene._pointer, desc, out]);
            const bindings = new Bindings(this, scene, handle);
            if (status !== STATUS.ok)
                throw new DocumentError(bindings.diagnostics);
            return bindings;
        });
    }

    // ---- Other models ----

    /** The document with its surfaces as another shading model, "gltf_pbr" (docs/translate.md). The diagnostics tell what is lost. With `joined` a surface
     * that is made of others, such as their <mix>, becomes one. Throws DocumentError. */
    translate(model, request = {}) {
        const { joined } = readOptions(request, { joined: false }), make = joined ? "mxg_translate_joined" : "mxg_translate";
        const native = this._native;
        return native.using(() => {
            const called = native.newText(model, "model");
            const { handle, status } = this.context._make(make, "mxg_result_destroy", [this._handle], out => [this._pointer, called, out]);
            const result = new Shader(native, handle), diagnostics = result.diagnostics;
            if (status !== STATUS.ok)
                throw new DocumentError(diagnostics);
            return { text: result._text(), diagnostics };
        });
    }

    // ---- Calls ----

    /** Checks every node, connection and value against the library, without generating. Errors are in the result. */
    validate() {
        const made = this.context._make("mxg_validate", "mxg_result_destroy", [this._handle], out => [this._pointer, out]);
        return new Shader(this._native, made.handle).diagnostics;
    }

    /** Calls `use` with the address of a mxg_generate_desc. */
    #request(target, request, use) {
        expectOptions(request, ["element", "stack", "options", "withoutSource", "onlyDiagnostics"]);
        const { element = null, stack = null, options = null, withoutSource = false, onlyDiagnostics = false } = request;
        if (stack && (!(stack.bindings instanceof Bindings) || stack.bindings.document !== this))
            throw new ArgumentError("the stack is not one of bindings of this document");
        if (element instanceof Element && element.document !== this)
            throw new ArgumentError("the element is of another document");
        const native = this._native, path = element instanceof Element ? element.path : element;
        return native.using(() => withOptions(this.context, options, made => use(native.newStruct("mxg_generate_desc", {
            target: native.newText(target, "target"), element: native.newOptionalText(path, "element"), options: made,
            bindings: stack ? stack.bindings._pointer : 0, stack: stack ? stack.number : 0, withoutSource, onlyDiagnostics }))));
    }

    #made(make) {
        const { handle, status } = make(), shader = new Shader(this._native, handle);
        if (status === STATUS.errorDocument)
            throw new DocumentError(shader.diagnostics);
        return shader;
    }

    /**
     * Makes a shader. `element` is a material, shader, node or output, a graph with one output, or a look with one material; null: the first
     * renderable. `stack`, of `Bindings`, stands in the place of an element. Throws DocumentError.
     */
    generate(target, request = {}) {
        return this.#made(() => this.#request(target, request, desc => this.context._make(
            "mxg_generate", "mxg_result_destroy", [this._handle], out => [this._pointer, desc, out])));
    }

    /** A text for people: "elements", "graph", "dot", "ir", "closures", "statistics" or "slabs". Throws DocumentError. */
    inspect(view, options = {}) {
        const { target = "glsl", ...request } = expect(options, "object", "options");
        const number = numberOf("mxg_view", view, "view");
        return this.#made(() => this.#request(target, request, desc => this.context._make(
            "mxg_inspect", "mxg_result_destroy", [this._handle], out => [this._pointer, number, desc, out])))._text();
    }
}
