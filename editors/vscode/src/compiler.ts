// SPDX-License-Identifier: Apache-2.0
// The library as WebAssembly, for what the extension itself does: shaders as documents, explanations, and messages and formatting
// where there is no language server.

import type { Context, Diagnostic, Document, Mxgen } from "mxgen";
import { DocumentError, instantiate } from "mxgen";
import * as vscode from "vscode";

import { join, readFile } from "./files";

const TOO_LONG = 10_000; // milliseconds of one call; the extension host answers nobody meanwhile

export class Compiler {
    #module: Promise<Mxgen> | null = null;
    #context: Context | null = null;
    #end = 0;

    constructor(private readonly extension: vscode.Uri) {}

    async mxgen(): Promise<Mxgen> {
        this.#module ??= (async () => instantiate(await vscode.workspace.fs.readFile(vscode.Uri.joinPath(this.extension, "dist", "mxgen.wasm"))))();
        return this.#module;
    }

    async #open(): Promise<Context> {
        const mxgen = await this.mxgen();
        this.#context ??= mxgen.createContext({ cancel: () => Date.now() > this.#end, resolver: () => null });
        this.#end = Date.now() + TOO_LONG;
        return this.#context;
    }

    /** Calls `use` with a document and the diagnostics of reading it. null: it is too broken to be one. */
    async withDocument<Answer>(source: vscode.TextDocument, use: (document: Document | null, diagnostics: Diagnostic[]) => Answer): Promise<Answer> {
        const context = await this.#open(), name = source.uri.toString();
        let document: Document | null = null, diagnostics: Diagnostic[] = [];
        try {
            document = await context.loadAsync(name, async (from, ref) => {
                const file = from ? join(from, ref) : name, data = file && await readFile(source.uri, file);
                return data ? { name: file, data } : null;
            });
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

    /** The text in one layout. Throws DocumentError. */
    async format(source: vscode.TextDocument): Promise<string> {
        return (await this.#open()).format(source.getText(), { name: source.uri.toString() });
    }
}
