// SPDX-License-Identifier: Apache-2.0
// Diagnostics: the errors, warnings and notes of a document, library or call.

import { ArgumentError } from "./errors.js";
import { expectCount, readOptions } from "./native.js";

/** The diagnostics of a document, library or call, in order of discovery. Notes follow the diagnostic that they explain. */
export class Diagnostics {
    #owner;
    #list;

    /** `list` is the native list, which lives as long as `owner`. */
    constructor(owner, list) {
        this.#owner = owner;
        this.#list = list;
        const native = owner._native;
        const found = native.records("mxg_diagnostic", native.lib.mxg_diagnostics_num_items(list),
                                     (index, out) => native.lib.mxg_diagnostics_item(list, index, out));
        this.items = Object.freeze(found.map(({ numArguments, ...item }, index) => ({ ...item,
            arguments: Array.from({ length: numArguments }, (_, argument) => native.text(native.lib.mxg_diagnostics_argument(list, index, argument))) })));
        this.errors = native.lib.mxg_diagnostics_num_errors(list);
        this.warnings = this.items.filter(item => item.severity === "warning").length;
    }

    get length() {
        return this.items.length;
    }

    [Symbol.iterator]() {
        return this.items[Symbol.iterator]();
    }

    /** Diagnostic `index` as compilers write it. With `source`, the text of the file, the output shows the line with a caret. */
    formatOne(index, request = {}) {
        const { source, colour } = readOptions(request, { source: null, colour: false });
        if (expectCount(index, "index") >= this.length)
            throw new ArgumentError(`there is no diagnostic ${index} of ${this.length}`);
        const native = this.#owner._native;
        this.#owner._handle; // throws after `destroy`
        return native.using(() => {
            const line = source?.split("\n")[this.items[index].line - 1]?.replace(/\r$/, "");
            const bytes = line === undefined ? null : new TextEncoder().encode(line), text = bytes ? native.newBytes(bytes) : 0;
            return native.sizedText((out, capacity) => native.lib.mxg_diagnostics_format(this.#list, index, text, bytes?.length ?? 0, colour, out,
                                                                                        capacity));
        });
    }

    /** All diagnostics. */
    format(options) {
        return this.items.map((_, index) => this.formatOne(index, options)).join("\n");
    }

    toString() {
        return this.format();
    }
}
