// SPDX-License-Identifier: Apache-2.0
// The library as WebAssembly, for what the extension itself does: shaders as documents, and explanations.

import type { Context, Diagnostic, Document, Library, Mxgen } from "mxgen";
import { DocumentError, instantiate } from "mxgen";
import * as vscode from "vscode";

import { join, readFile, readLibraries } from "./files";
import { loadLibraries, resolve } from "./library";

const TOO_LONG = 10_000; // milliseconds of one call; the extension host answers nobody meanwhile

export class Compiler {
    #module: Promise<Mxgen> | null = null;
    #opening: Promise<{ context: Context; library: Library | null }> | null = null;
    #end = 0;

    constructor(private readonly extension: vscode.Uri) {}

    async mxgen(): Promise<Mxgen> {
        this.#module ??= (async () => instantiate(await vscode.workspace.fs.readFile(vscode.Uri.joinPath(this.extension, "dist", "mxgen.wasm"))))();
        return this.#module;
    }

    /** Reads the libraries of the settings anew. */
    forget(): void {
        this.#opening = null;
    }

    async #start(): Promise<{ context: Context; library: Library | null }> {
        const mxgen = await this.mxgen(), files = new Map(await readLibraries());
        const context = mxgen.createContext({ cancel: () => Date.now() > this.#end, resolver: (from, ref) => {
            const name = resolve(from, ref), data = name !== null && files.get(name);
            return data ? { name, data } : null;
        } });
        this.#end = Date.now() + TOO_LONG;
        try {
            return { context, library: loadLibraries(context, files.keys()) };
        } catch (error) {
            void vscode.window.showWarningMessage(`mxgen.libraries: ${error instanceof Error ? error.message.split("\n")[0] : error}`);
            return { context, library: null };
        }
    }

    async #open(): Promise<{ context: Context; library: Library | null }> {
        const opened = await (this.#opening ??= this.#start());
        this.#end = Date.now() + TOO_LONG;
        return opened;
    }

    /** Calls `use` with a document and the diagnostics of reading it. null: it is too broken to be one. */
    async withDocument<Answer>(source: vscode.TextDocument, use: (document: Document | null, diagnostics: Diagnostic[]) => Answer): Promise<Answer> {
        const { context, library } = await this.#open(), name = source.uri.toString();
        let document: Document | null = null, diagnostics: Diagnostic[] = [];
        try {
            document = await context.loadAsync(name, async (from, ref) => {
                const file = from ? join(from, ref) : name, data = file && await readFile(source.uri, file);
                return data ? { name: file, data } : null;
            }, { library });
            diagnostics = [...document.diagnostics];
        } catch (error) {
            if (!(error instanceof DocumentError))
                throw error;
            document = error.document;
            diagnostics = [...error.diagnostics];
        }
        this.#end = Date.now() + TOO_LONG;
        try {
            return use(document, diagnostics);
        } finally {
            document?.destroy();
        }
    }
}
