// SPDX-License-Identifier: Apache-2.0
// Libraries and the node definitions in them.

import { Diagnostics } from "./diagnostics.js";
import { ArgumentError } from "./errors.js";
import { expect, Owner } from "./native.js";

const READERS = {
    library: { nodedef: "mxg_library_nodedef", port: "mxg_library_port", numImplementations: "mxg_library_num_implementations",
               implementation: "mxg_library_implementation" },
    document: { nodedef: "mxg_document_nodedef", port: "mxg_document_port", numImplementations: "mxg_document_num_implementations",
                implementation: "mxg_document_implementation" },
};

/** The definition `index` of a library or document, with its ports and implementations. `kind` is "library" or "document". */
export function readNodeDef(owner, index, kind) {
    const native = owner._native, call = (name, ...rest) => native.lib[READERS[kind][name]](owner._pointer, index, ...rest);
    const nodedef = native.record("mxg_nodedef", out => call("nodedef", out));
    const ports = native.records("mxg_port", nodedef.numInputs + nodedef.numOutputs, (port, out) => call("port", port, out));
    nodedef.implementations = native.records("mxg_implementation", call("numImplementations"), (at, out) => call("implementation", at, out));
    nodedef.inputs = ports.slice(0, nodedef.numInputs);
    nodedef.outputs = ports.slice(nodedef.numInputs);
    delete nodedef.numInputs;
    delete nodedef.numOutputs;
    return nodedef;
}

/** Node definitions; immutable. */
export class Library extends Owner {
    #byName;

    constructor(native, handle) {
        super(native, handle, "library");
    }

    /** The diagnostics of loading it. */
    get diagnostics() {
        return new Diagnostics(this, this._native.lib.mxg_library_diagnostics(this._pointer));
    }

    /** Its files, and those of its bases. The built-in library has none. */
    get files() {
        const { lib } = this._native, pointer = this._pointer;
        return Array.from({ length: lib.mxg_library_num_files(pointer) }, (_, index) => this._native.text(lib.mxg_library_file(pointer, index)));
    }

    toString() {
        return `Library, ${this.nodedefNames.length} definitions`;
    }

    #index() {
        if (!this.#byName) {
            const { lib } = this._native;
            const infos = this._native.records("mxg_nodedef", lib.mxg_library_num_nodedefs(this._pointer),
                                               (index, out) => lib.mxg_library_nodedef(this._pointer, index, out));
            this.#byName = new Map(infos.map((info, index) => [info.name, index])); // a later definition replaces an earlier one
        }
        return this.#byName;
    }

    /** The names of all definitions, with those of the bases. */
    get nodedefNames() {
        this._handle;
        return [...this.#index().keys()];
    }

    /** The definition of a name: "ND_image_color3"; null: there is none. */
    nodedef(name) {
        const index = (this._handle, this.#index()).get(expect(name, "string", "name"));
        return index === undefined ? null : readNodeDef(this, index, "library");
    }

    /** Whether a definition has an implementation for a target. */
    supports(name, target) {
        const index = (this._handle, this.#index()).get(expect(name, "string", "name"));
        if (index === undefined)
            throw new ArgumentError(`the library has no definition '${name}'`);
        return this._native.using(() => this._native.lib.mxg_library_has_implementation(this._pointer, index, this._native.newText(target, "target")) !== 0);
    }

    /** The library image, for `Context.loadLibrary(…, { standalone: true })`. The library must be standalone. */
    image() {
        const native = this._native;
        return native.using(() => {
            const data = native.space(4), size = native.space(4), status = native.lib.mxg_library_image(this._pointer, data, size);
            if (status !== 0)
                throw native.errorOf(status, status === 2 ? "the library must be standalone" : "");
            return native.bytes(native.pointer(data), native.pointer(size)).slice();
        });
    }

    /** The library as a plain MaterialX document with all templates expanded. */
    expand() {
        const text = this._native.text(this._native.lib.mxg_library_xml(this._pointer, 0));
        if (text === null)
            throw this._native.errorOf(3);
        return text;
    }

    /** A warning for each input that `expand` cannot say in graphs for other tools. */
    get losses() {
        const losses = this._native.lib.mxg_library_losses(this._pointer);
        if (!losses)
            throw this._native.errorOf(3);
        return new Diagnostics(this, losses);
    }
}
