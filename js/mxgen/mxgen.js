// SPDX-License-Identifier: Apache-2.0
// mxgen over a module of WebAssembly, for Node and browsers alike.

import { Context } from "./context.js";
import { ArgumentError } from "./errors.js";
import { LanguageServer } from "./language_server.js";
import { ENUMS } from "./layout.js";
import { expect, Native } from "./native.js";
import { slotText } from "./scene.js";

export * from "./errors.js";
export { Context } from "./context.js";
export { Diagnostics } from "./diagnostics.js";
export { Document, Element } from "./document.js";
export { Draft, Edit } from "./edit.js";
export { LanguageServer } from "./language_server.js";
export { Library } from "./library.js";
export { Bindings, Primitive, Scene } from "./scene.js";
export { Shader } from "./shader.js";

/** An instance of mxgen with memory of its own. */
export class Mxgen {
    #native;
    #defaults;

    constructor(native, defaults) {
        this.#native = native;
        this.#defaults = defaults;
    }

    createContext(options = {}) {
        return new Context(this.#native, options, this.#defaults);
    }

    /** A language server (docs/lsp.md): `send` takes its messages. index.d.ts describes the options. */
    createLanguageServer(options) {
        return new LanguageServer(this.#native, expect(options, "object", "options").library ?? this.createContext().library, options);
    }

    /** The version of the library. */
    get version() {
        return this.#native.text(this.#native.lib.mxg_version_string());
    }

    /** Every target. */
    get targets() {
        const { lib } = this.#native;
        return this.#native.records("mxg_target", lib.mxg_catalogue_num_targets(), (index, out) => lib.mxg_catalogue_target(index, out)).map(
            ({ stageSuffix: [vertex, pixel], passSuffix: [pass, functions], ...target }) => ({ ...target, suffixes: { vertex, pixel, pass, functions } }));
    }

    /** Every option of `Document.generate`. */
    get options() {
        const { lib } = this.#native;
        return this.#native.records("mxg_option", lib.mxg_catalogue_num_options(), (index, out) => lib.mxg_catalogue_option(index, out));
    }

    /** The resources that the passes of the deferred pipeline share; the place in the list is the binding. */
    get passResources() {
        const { lib } = this.#native;
        const found = this.#native.records("mxg_pass_resource", lib.mxg_catalogue_num_pass_resources(), (index, out) => lib.mxg_catalogue_pass_resource(index, out));
        return found.map(({ numMembers, ...resource }, binding) => ({ ...resource,
            members: this.#native.records("mxg_pass_member", numMembers, (index, out) => lib.mxg_catalogue_pass_member(binding, index, out)) }));
    }

    /** Whether an option has a meaning for a target, which ignores the others. */
    optionApplies(key, target) {
        const index = this.options.findIndex(option => option.key === expect(key, "string", "key"));
        if (index < 0)
            throw new ArgumentError(`there is no option '${key}'`);
        if (!this.targets.some(({ name }) => name === expect(target, "string", "target")))
            throw new ArgumentError(`there is no target '${target}'`);
        return this.#native.using(() => this.#native.lib.mxg_catalogue_has_option(index, this.#native.newText(target, "target")) !== 0);
    }

    /** The name of a slot in USD: "050::010" is "_050:_:_010". */
    encodeSlot(name) {
        return slotText(this.#native, "mxg_slot_encode", name, "a name of a slot");
    }

    /** The reverse of `encodeSlot`. */
    decodeSlot(identifiers) {
        return slotText(this.#native, "mxg_slot_decode", identifiers, "an encoded name of a slot");
    }

    /** Every diagnostic that mxgen can report. */
    get diagnosticKinds() {
        const { lib } = this.#native;
        return this.#native.records("mxg_diagnostic_kind", lib.mxg_catalogue_num_diagnostic_kinds(), (index, out) => lib.mxg_catalogue_diagnostic_kind(index, out));
    }

    /** The meanings of variables without a path. */
    get semantics() {
        const { lib } = this.#native;
        return this.#native.records("mxg_semantic", lib.mxg_catalogue_num_semantics(), (index, out) => lib.mxg_catalogue_semantic(index, out));
    }

    /** The values of an enumeration of the C interface: "mxg_view". */
    static valuesOf(type) {
        return Object.keys(ENUMS[type]);
    }
}

/** Makes an instance from the bytes of mxgen.wasm or from a compiled module. `defaults` are callbacks for contexts without a resolver. */
export async function instantiate(source, defaults = {}) {
    const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source);
    return new Mxgen(await Native.instantiate(module), defaults);
}
