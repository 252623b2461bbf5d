// SPDX-License-Identifier: Apache-2.0
// The desktop and the browser edition share this: the preview and the commands.

import * as vscode from "vscode";

import { Compiler } from "./compiler";
import { Preview } from "./preview";
import { Messages, MESSAGE, SHADER, Shaders } from "./shaders";

/** The MaterialX document that a command is for; tells that there is none. */
export function activeDocument(): vscode.TextDocument | null {
    const document = vscode.window.activeTextEditor?.document;
    if (document?.languageId === "materialx")
        return document;
    void vscode.window.showWarningMessage("Open a MaterialX document (.mtlx) first.");
    return null;
}

/** A command that tells its failures. */
export function register(name: string, work: (...given: any[]) => unknown): vscode.Disposable {
    return vscode.commands.registerCommand(name, async (...given) => {
        try {
            await work(...given);
        } catch (error) {
            void vscode.window.showErrorMessage(`mxgen: ${error instanceof Error ? error.message : error}`);
        }
    });
}

export function start(context: vscode.ExtensionContext): Compiler {
    const compiler = new Compiler(context.extensionUri), shaders = new Shaders(compiler), messages = new Messages(compiler);
    const preview = new Preview(context.extensionUri, shaders);
    const readLibraries = () => {
        compiler.forget();
        return preview.sendLibraries();
    };
    context.subscriptions.push(shaders, preview,
        vscode.workspace.onDidGrantWorkspaceTrust(readLibraries),
        vscode.workspace.onDidChangeConfiguration(event => event.affectsConfiguration("mxgen.libraries") && readLibraries()),
        vscode.workspace.registerTextDocumentContentProvider(SHADER, shaders),
        vscode.workspace.registerTextDocumentContentProvider(MESSAGE, messages),
        register("mxgen.preview", () => {
            const document = activeDocument();
            return document && preview.show(document);
        }),
        register("mxgen.generate", () => {
            const document = activeDocument();
            return document && shaders.open(document);
        }),
        register("mxgen.explain", (id?: string) => messages.show(id)),
        register("mxgen.format", () => activeDocument() && vscode.commands.executeCommand("editor.action.formatDocument")));
    return compiler;
}
