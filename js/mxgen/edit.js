// SPDX-License-Identifier: Apache-2.0
// Edits: documents made from nothing or from other documents.

import { Document, Element } from "./document.js";
import { ArgumentError, DocumentError, EditError } from "./errors.js";
import { expect, expectEach, Handle, kindOf, Owner, STATUS } from "./native.js";

/** A value as MaterialX text. */
function textOf(value) {
    if (typeof value === "string" || typeof value === "boolean")
        return String(value);
    const numbers = typeof value === "number" ? [value] : Array.isArray(value) || ArrayBuffer.isView(value) ? [...value] : null;
    if (!numbers || !numbers.every(number => typeof number === "number" && Number.isFinite(Math.fround(number))))
        throw new TypeError(`value must be a string, boolean, number or an array of numbers, which are finite as floats of 32 bits, not ${kindOf(value)}`);
    return numbers.join(", ");
}

/** An element of an edit. Its methods change the edit. */
export class Draft {
    constructor(edit, number) {
        this.edit = edit;
        this.number = number;
    }

    /** Appends an element below. The name must be new there. */
    add(category, name = null, type = null) {
        return this.edit._made((lib, native, pointer) => lib.mxg_edit_add_element(pointer, this.number, native.newText(category, "category"),
            native.newOptionalText(name, "name"), native.newOptionalText(type, "type")));
    }

    /** The element of a name directly below; null: there is none. */
    child(name) {
        const native = this.edit._native;
        const number = native.using(() => {
            const path = native.newText(name, "name");
            return name && native.lib.mxg_edit_find_element(this.edit._pointer, this.number, path);
        });
        return number ? new Draft(this.edit, number) : null;
    }

    /** Sets an attribute; null removes it. */
    set(attribute, value) {
        this.edit._change((lib, native, pointer) => lib.mxg_edit_set_attribute(pointer, this.number, native.newText(attribute, "attribute"),
                                                                    native.newOptionalText(value, "value")));
        return this;
    }

    /** Renames the element, and changes the references to it. */
    rename(name) {
        this.edit._change((lib, native, pointer) => lib.mxg_edit_rename_element(pointer, this.number, native.newText(name, "name")));
        return this;
    }

    /**
     * A name that is new below the element: this one, with "_" for what no name can have, or the same with the next free number.
     */
    uniqueName(name) {
        let made = expect(name, "string", "name").replace(/\W/g, "_").replace(/^(?=\d|$)/, "_");
        const stem = made.replace(/\d+$/, "");
        for (let number = Number(made.slice(stem.length) || 1) + 1; this.child(made); number++)
            made = `${stem}${number}`;
        return made;
    }

    /** Gives an input of a node a value, and removes its connection. `type` null: the type of the input, or that of the definition. */
    value(input, value, type = null) {
        const text = textOf(value);
        this.edit._change((lib, native, pointer) => lib.mxg_edit_set_value(pointer, this.number, native.newText(input, "input"),
            native.newOptionalText(type, "type"), native.newText(text, "value")));
        return this;
    }

    /**
     * Connects an input of a node, or an <output> element (then `input` is null), to a node, a nodegraph or an input of the nodegraph
     * around it. `output` null: the only output of the source.
     */
    connect(input, source, output = null) {
        const from = this.edit._own(source);
        this.edit._change((lib, native, pointer) => lib.mxg_edit_connect_input(pointer, this.number, native.newOptionalText(input, "input"),
            from, native.newOptionalText(output, "output")));
        return this;
    }

    /** Removes the element with all below it. */
    remove() {
        this.edit._change((lib, _, pointer) => lib.mxg_edit_remove_element(pointer, this.number));
    }

    /** Moves the element before another one (null: to the end) below `parent` (null: the root). */
    move(parent = null, before = null) {
        const [below, next] = [parent, before].map(other => other === null ? 0 : this.edit._own(other));
        this.edit._change((lib, _, pointer) => lib.mxg_edit_move_element(pointer, this.number, below, next));
        return this;
    }

    /**
     * Replaces the node by the nodes of the nodegraph that implements its definition. Their names begin with its name, and the one behind
     * its only output has the name itself.
     */
    flatten() {
        this.edit._change((lib, _, pointer) => lib.mxg_edit_flatten_node(pointer, this.number));
    }

    /** Appends a copy of an element of any document, with all below it. */
    copy(element, name = null) {
        expect(element, Element, "element");
        if (element.document._native !== this.edit._native)
            throw new ArgumentError("the element is of another instance of mxgen");
        return this.edit._made((lib, native, pointer) => lib.mxg_edit_copy_element(pointer, this.number, element.document._pointer, element.number,
                                                                          native.newOptionalText(name, "name")));
    }
}

/**
 * A document under construction. `Context.edit` and `Document.edit` begin one; `end` makes the document. A call that fails throws EditError
 * and changes nothing.
 */
export class Edit extends Owner {
    #context;
    #library;
    #source;

    constructor(context, library, source, handle) {
        super(context._native, handle, "edit");
        this.#context = context;
        this.#library = library;
        this.#source = source;
    }

    // ---- Calls ----

    /** The number of an element of the edit, or of the document that it comes from. */
    _own(element) {
        const draft = element instanceof Element ? this.find(element) : element;
        if (expect(draft, Draft, "an element of the edit").edit !== this)
            throw new ArgumentError("the element is of another edit");
        return draft.number;
    }

    #reason(pointer) {
        return this._native.sizedText((out, capacity) => this._native.lib.mxg_edit_error(pointer, out, capacity));
    }

    _change(work) {
        const native = this._native, pointer = this._pointer;
        const status = native.using(() => this.#context._turn(() => work(native.lib, native, pointer)));
        if (status === STATUS.errorArgument)
            throw new EditError(this.#reason(pointer) || "the edit is impossible");
        native.check(status);
    }

    _made(work) {
        const native = this._native, pointer = this._pointer;
        const number = native.using(() => this.#context._turn(() => work(native.lib, native, pointer)));
        if (number)
            return new Draft(this, number);
        const reason = this.#reason(pointer);
        throw reason ? new EditError(reason) : native.errorOf(STATUS.errorMemory);
    }

    // ---- Elements ----

    /** <materialx>. */
    get root() {
        this._handle;
        return new Draft(this, 0);
    }

    /** An element by path, as the edit is now, or an element of the document that the edit comes from; null: there is none. */
    find(path) {
        if (path instanceof Element) {
            if (path.document !== this.#source)
                throw new ArgumentError("the edit comes from another document");
            return new Draft(this, path.number);
        }
        const native = this._native, number = native.using(() => native.lib.mxg_edit_find_element(this._pointer, 0, native.newText(path, "path")));
        return number ? new Draft(this, number) : null;
    }

    /** Appends an element to the root. */
    add(category, name = null, type = null) {
        return this.root.add(category, name, type);
    }

    /** Appends a copy of an element of any document to the root. */
    copy(element, name = null) {
        return this.root.copy(element, name);
    }

    /**
     * Moves nodes of the root into a new nodegraph, in this order. Sources outside that they read become its inputs, and results that
     * others read its outputs.
     */
    group(nodes, name) {
        const numbers = Array.from(expectEach(nodes, "nodes"), node => this._own(node));
        return this._made((lib, native, pointer) => lib.mxg_edit_group_nodes(pointer, native.newNumbers(numbers), numbers.length,
                                                                         native.newText(name, "name")));
    }

    /**
     * Makes the definition `name` of the kind of node `node` from a nodegraph of the root, which then implements it. Where elements read the
     * nodegraph, a node of the definition takes its place.
     */
    define(nodegraph, name, node) {
        const number = this._own(nodegraph);
        return this._made((lib, native, pointer) => lib.mxg_edit_define_nodegraph(pointer, number, native.newText(name, "name"), native.newText(node, "node")));
    }

    // ---- End ----

    /** Makes the document. The edit is over, also after an error. Throws DocumentError. */
    end() {
        const native = this._native, pointer = this._pointer, handle = this._take();
        let made = null, status;
        try {
            native.using(() => {
                const out = native.space(4);
                try {
                    status = this.#context._turn(() => native.lib.mxg_edit_commit(pointer, out));
                } finally {
                    if (native.pointer(out))
                        made = new Handle(native.pointer(out), native.lib.mxg_document_destroy, [this.#context._handle, this.#library._handle]);
                }
            });
        } catch (error) {
            made?.release();
            throw error;
        } finally {
            handle.release();
        }
        if (!made)
            throw native.errorOf(status);
        const document = new Document(this.#context, this.#library, made);
        if (status === STATUS.errorDocument)
            throw new DocumentError(document.diagnostics, document);
        native.check(status);
        return document;
    }

    /** Drops the edit. */
    cancel() {
        this.destroy();
    }
}
