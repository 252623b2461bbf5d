// SPDX-License-Identifier: Apache-2.0
// The entry where programs can start: the language server, and `mxgen render`.

import { execFile } from "node:child_process";
import { promisify } from "node:util";
import * as vscode from "vscode";

import { activeDocument, register, start } from "./extension";
import { Language, type Stoppable } from "./language";
import { programOptions, programPath, startServer, startThread } from "./server";

async function tell(): Promise<void> {
    const open = "Open Settings";
    const chosen = await vscode.window.showWarningMessage(`The program "${programPath()}" does not start: a slower language server stands in for it, and nothing renders pictures. `
        + "Build mxgen and set mxgen.path.", open);
    if (chosen === open)
        await vscode.commands.executeCommand("workbench.action.openSettings", "mxgen.path");
}

/** The language server of the program, or else that of the extension. */
async function serve(extension: vscode.Uri): Promise<Stoppable> {
    try {
        return await startServer();
    } catch {
        void tell();
        return startThread(extension);
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
    start(context);
    context.subscriptions.push(register("mxgen.render", (document?: string, material?: string) => render(context.globalStorageUri, document, material)));
    language = new Language(context, ["path", "libraries", "includeRoots", "reference"], () => serve(context.extensionUri));
    await language.restart();
}

export const deactivate = () => language?.stop();
