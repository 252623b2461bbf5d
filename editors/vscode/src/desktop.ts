// SPDX-License-Identifier: Apache-2.0
// The entry where programs can start: the language server, and `mxgen render`.

import { execFile } from "node:child_process";
import { promisify } from "node:util";
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";

import { startBuiltin } from "./builtin";
import type { Compiler } from "./compiler";
import { activeDocument, register, start } from "./extension";
import { programOptions, programPath, startServer } from "./server";

/** The language server; without it what the module of WebAssembly can do. */
class Language implements vscode.Disposable {
    #client: LanguageClient | null = null;
    #builtin: vscode.Disposable | null = null;
    #turn: Promise<void> = Promise.resolve();

    constructor(private readonly compiler: Compiler) {}

    /** Starts anew, after the starts before. */
    restart(): Promise<void> {
        return this.#turn = this.#turn.then(async () => {
            await this.stop();
            try {
                this.#client = await startServer();
            } catch {
                this.#builtin = startBuiltin(this.compiler);
                void this.#tell();
            }
        });
    }

    async #tell(): Promise<void> {
        const open = "Open Settings";
        const chosen = await vscode.window.showWarningMessage(`The program "${programPath()}" does not start, so there is no completion and no hover; messages, formatting and the preview work. `
            + "Build mxgen and set mxgen.path.", open);
        if (chosen === open)
            await vscode.commands.executeCommand("workbench.action.openSettings", "mxgen.path");
    }

    async stop(): Promise<void> {
        this.#builtin?.dispose();
        this.#builtin = null;
        const client = this.#client;
        this.#client = null;
        await client?.dispose();
    }

    dispose(): void {
        void this.stop();
    }
}

/** Draws a material of the saved document, or its first one, with `mxgen render`, and shows the picture. */
async function render(storage: vscode.Uri, document?: string, material?: string): Promise<void> {
    const source = document ? await vscode.workspace.openTextDocument(vscode.Uri.parse(document)) : activeDocument();
    if (!source)
        return;
    if (source.uri.scheme !== "file" || (source.isDirty && !await source.save()))
        throw new Error("the program draws saved files only");
    await vscode.workspace.fs.createDirectory(storage);
    const name = material ?? source.uri.path.split("/").at(-1)!.replace(/\.mtlx$/, ""), picture = vscode.Uri.joinPath(storage, `${name}.png`);
    const progress = { location: vscode.ProgressLocation.Notification, title: `Rendering ${name}`, cancellable: true };
    await vscode.window.withProgress(progress, async (_, token) => {
        const stop = new AbortController();
        token.onCancellationRequested(() => stop.abort());
        try {
            await promisify(execFile)(programPath(), ["render", source.uri.fsPath, ...material ? ["-e", material] : [], ...programOptions(), "-o", picture.fsPath], { signal: stop.signal });
        } catch (error) {
            if (stop.signal.aborted)
                return;
            throw new Error((error as { stderr?: string }).stderr?.trim().split("\n")[0] || String(error));
        }
        await vscode.commands.executeCommand("vscode.open", picture, vscode.ViewColumn.Beside);
    });
}

let language: Language | null = null;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    const here = language = new Language(start(context)), restart = () => here.restart();
    context.subscriptions.push(here,
        register("mxgen.restart", restart),
        register("mxgen.render", (document?: string, material?: string) => render(context.globalStorageUri, document, material)),
        vscode.workspace.onDidGrantWorkspaceTrust(restart),
        vscode.workspace.onDidChangeConfiguration(event => {
            if (["path", "libraries", "includeRoots", "reference"].some(key => event.affectsConfiguration(`mxgen.${key}`)))
                void restart();
        }));
    await restart();
}

export const deactivate = () => language?.stop();
