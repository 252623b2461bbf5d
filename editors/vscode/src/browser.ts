// SPDX-License-Identifier: Apache-2.0
// The entry in browsers, which start no programs.

import * as vscode from "vscode";
import { LanguageClient } from "vscode-languageclient/browser";

import { start } from "./extension";
import { Language, type Stoppable } from "./language";
import { clientOptions, startWorker } from "./wasm";

async function startServer(extension: vscode.Uri): Promise<Stoppable> {
    const script = await vscode.workspace.fs.readFile(vscode.Uri.joinPath(extension, "dist", "worker.js"));
    const address = URL.createObjectURL(new Blob([new Uint8Array(script)], { type: "text/javascript" })), worker = new Worker(address);
    const client = new LanguageClient("mxgen", "MaterialX (mxgen)", clientOptions, worker);
    await startWorker(extension, worker, client);
    return {
        dispose: () => client.dispose().finally(() => {
            worker.terminate();
            URL.revokeObjectURL(address);
        }),
    };
}

let language: Language | null = null;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    start(context);
    language = new Language(context, ["libraries", "includeRoots"], () => startServer(context.extensionUri));
    await language.restart();
}

export const deactivate = () => language?.stop();
