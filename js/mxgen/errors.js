// SPDX-License-Identifier: Apache-2.0
// Exceptions. Each has a text that names the fault.

/** The base class of mxgen's exceptions. */
export class MxgenError extends Error {
    constructor(message) {
        super(message);
        this.name = new.target.name;
    }
}

/** A value that the call does not accept: an unknown target, option or path. */
export class ArgumentError extends MxgenError {}

/** An edit that cannot be made. The document under construction is as it was before the call. */
export class EditError extends ArgumentError {}

/** There is no memory left, or the context reached `maxMemory`. */
export class OutOfMemoryError extends MxgenError {}

/** The callback `cancel` returned true. */
export class CancelledError extends MxgenError {}

/** A bug in mxgen. The instance of WebAssembly may have ended; `load` makes another one. */
export class InternalError extends MxgenError {}

/** A document, library or request has errors. The text lists them. */
export class DocumentError extends MxgenError {
    /**
     * `diagnostics` has every diagnostic of the call; `document` is the document with its errors, where the call made one: its parts
     * without errors can be used.
     */
    constructor(diagnostics, document = null) {
        super(diagnostics.format());
        this.diagnostics = diagnostics;
        this.document = document;
    }
}
