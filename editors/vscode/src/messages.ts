// SPDX-License-Identifier: Apache-2.0
// The messages between the extension and its preview, and between it and the language server as WebAssembly.

import type { LibraryFile } from "./files";
import type { InputPlace } from "@web/changes.js";

/** Line and column from 1; columns count characters. */
export interface Position {
    line: number;
    column: number;
}

/** `file` is the address of a file, as the extension named it. */
export interface Place extends Position {
    file: string;
}

export type ToView =
    /** The document that the preview shows, also after each change. */
    | { type: "document"; name: string; text: string; cursor: Position }
    | { type: "cursor"; cursor: Position }
    /** The files of the libraries in the settings, before the first document. */
    | { type: "libraries"; files: LibraryFile[] }
    /** The answer to `read`, and again when the file changes. null: there is none that the document may read. */
    | { type: "file"; name: string; content: Uint8Array<ArrayBuffer> | null }
    | { type: "texture"; name: string; file: string; content: Uint8Array<ArrayBuffer> | null };

export type FromView =
    | { type: "ready" }
    | { type: "read"; name: string }
    /** `file` is a texture as the file `from` names it, of the document `name`. */
    | { type: "readTexture"; name: string; from: string; file: string }
    | { type: "reveal"; place: Place }
    | { type: "setInput"; place: InputPlace & { file: string }; value: string }
    | { type: "openShader"; name: string; element: string; target: string };

/** The first message to the server; those of the protocol follow. */
export interface ServerStart {
    wasm: Uint8Array<ArrayBuffer>;
    libraries: LibraryFile[];
    includeRoots: string[];
}

/** Requests of the server with `{ path }`: the bytes of a file, and the names in a folder, where folders end with '/'; null: it is not there. */
export const READ_FILE = "mxgen/readFile", LIST_FOLDER = "mxgen/listFolder";
