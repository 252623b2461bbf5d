// SPDX-License-Identifier: Apache-2.0
// The panel beside the text. It shows the MaterialX document that was active last; view/ draws it, and this side gives it texts
// and files, and writes what its controls change.

import * as vscode from "vscode";

import { join, readFile, readLibraries } from "./files";
import type { FromView, Place, Position, ToView } from "./messages";
import type { Shaders } from "./shaders";
import { changeOfInput, offsetOf } from "@web/changes.js";

const TYPE = "mxgen.preview";

/** The cursor; before the first letter of a line it counts as being at that letter. */
function cursorOf(document: vscode.TextDocument): Position {
    const editor = vscode.window.visibleTextEditors.find(one => one.document === document), place = editor?.selection.active;
    if (!place)
        return { line: 1, column: 1 };
    const { text, firstNonWhitespaceCharacterIndex } = document.lineAt(place.line);
    return { line: place.line + 1, column: [...text.slice(0, Math.max(place.character, firstNonWhitespaceCharacterIndex))].length + 1 };
}

export class Preview implements vscode.WebviewPanelSerializer, vscode.Disposable {
    #panel: vscode.WebviewPanel | null = null;
    #source: vscode.TextDocument | null = null;
    readonly #given = new Map<string, () => Promise<void>>(); // how files that the view has are sent again, by their addresses
    readonly #listeners: vscode.Disposable[];

    constructor(private readonly extension: vscode.Uri, private readonly shaders: Shaders) {
        const watcher = vscode.workspace.createFileSystemWatcher("**/*"), changed = (uri: vscode.Uri) => this.#fileChanged(uri);
        this.#listeners = [watcher, watcher.onDidChange(changed), watcher.onDidCreate(changed), watcher.onDidDelete(changed),
            vscode.window.registerWebviewPanelSerializer(TYPE, this),
            vscode.workspace.onDidChangeTextDocument(({ document }) => {
                if (document === this.#source)
                    this.#sendDocument();
                else
                    changed(document.uri);
            }),
            vscode.window.onDidChangeActiveTextEditor(editor => {
                if (this.#panel && editor?.document.languageId === "materialx" && editor.document !== this.#source)
                    this.#setSource(editor.document);
            }),
            vscode.window.onDidChangeTextEditorSelection(({ textEditor: { document } }) => {
                if (document === this.#source)
                    this.#post({ type: "cursor", cursor: cursorOf(document) });
            })];
    }

    show(source: vscode.TextDocument): void {
        const column = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
        if (this.#panel)
            this.#panel.reveal(this.#panel.viewColumn, true);
        else
            this.#open(vscode.window.createWebviewPanel(TYPE, "Preview", column, { retainContextWhenHidden: true }));
        this.#setSource(source);
    }

    /** Opens the panel again that was open when the window closed. */
    async deserializeWebviewPanel(panel: vscode.WebviewPanel, state?: { name?: string }): Promise<void> {
        this.#open(panel);
        const editor = vscode.window.visibleTextEditors.find(({ document }) => document.languageId === "materialx");
        const source = editor?.document ?? (state?.name ? await vscode.workspace.openTextDocument(vscode.Uri.parse(state.name)) : null);
        if (source)
            this.#setSource(source);
    }

    #open(panel: vscode.WebviewPanel): void {
        const root = vscode.Uri.joinPath(this.extension, "dist");
        this.#panel = panel;
        panel.webview.options = { enableScripts: true, localResourceRoots: [root] };
        panel.iconPath = { light: vscode.Uri.joinPath(this.extension, "media", "file-light.svg"), dark: vscode.Uri.joinPath(this.extension, "media", "file-dark.svg") };
        panel.onDidDispose(() => {
            this.#panel = this.#source = null;
            this.#given.clear();
        });
        panel.webview.onDidReceiveMessage((message: FromView) => this.#answer(message).catch(error => void vscode.window.showErrorMessage(`mxgen: ${error.message}`)));
        panel.webview.html = pageOf(panel.webview, root);
    }

    #setSource(source: vscode.TextDocument): void {
        this.#source = source;
        this.#given.clear();
        this.#panel!.title = `Preview ${source.uri.path.split("/").at(-1)}`;
        this.#sendDocument();
    }

    #post(message: ToView): void {
        void this.#panel?.webview.postMessage(message);
    }

    #sendDocument(): void {
        if (this.#source)
            this.#post({ type: "document", name: this.#source.uri.toString(), text: this.#source.getText(), cursor: cursorOf(this.#source) });
    }

    /** Sends what `message` makes of a file, now and when it changes. */
    async #give(address: string | null, message: (content: Uint8Array<ArrayBuffer> | null) => ToView): Promise<void> {
        const source = this.#source, send = async () => {
            const content = source && address ? await readFile(source.uri, address) : null;
            if (source === this.#source)
                this.#post(message(content));
        };
        if (address)
            this.#given.set(vscode.Uri.parse(address).toString(), send);
        await send();
    }

    #fileChanged(uri: vscode.Uri): void {
        void this.#given.get(uri.toString())?.();
    }

    /** Sends the libraries of the settings. */
    async sendLibraries(): Promise<void> {
        if (this.#panel)
            this.#post({ type: "libraries", files: await readLibraries() });
    }

    async #answer(message: FromView): Promise<void> {
        switch (message.type) {
        case "ready":
            await this.sendLibraries();
            return this.#sendDocument();
        case "read": {
            const { name } = message;
            return this.#give(name, content => ({ type: "file", name, content }));
        }
        case "readTexture": {
            const { name, from, file } = message;
            return this.#give(join(from, file), content => ({ type: "texture", name, file, content }));
        }
        case "reveal":
            return reveal(message.place);
        case "setInput": {
            const { place, value } = message, document = await vscode.workspace.openTextDocument(vscode.Uri.parse(place.file));
            const change = changeOfInput(document.getText(), place, value), edit = new vscode.WorkspaceEdit();
            if (!change)
                throw new Error(`"${place.node}" is not where it was; the text keeps its value`);
            edit.replace(document.uri, new vscode.Range(document.positionAt(change.start), document.positionAt(change.end)), change.text);
            await vscode.workspace.applyEdit(edit);
            return;
        }
        case "openShader": {
            const document = await vscode.workspace.openTextDocument(vscode.Uri.parse(message.name));
            return this.shaders.open(document, message);
        }
        }
    }

    dispose(): void {
        this.#panel?.dispose();
        for (const listener of this.#listeners)
            listener.dispose();
    }
}

/** Shows an element in the text, without leaving the preview. */
async function reveal({ file, line, column }: Place): Promise<void> {
    const document = await vscode.workspace.openTextDocument(vscode.Uri.parse(file));
    const shown = vscode.window.visibleTextEditors.find(one => one.document === document);
    const at = document.positionAt(offsetOf(document.getText(), line, column));
    const editor = await vscode.window.showTextDocument(document, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.One });
    editor.selection = new vscode.Selection(at, at);
    editor.revealRange(new vscode.Range(at, at), vscode.TextEditorRevealType.InCenterIfOutsideViewport);
}

function pageOf(webview: vscode.Webview, root: vscode.Uri): string {
    const address = (name: string) => webview.asWebviewUri(vscode.Uri.joinPath(root, name)).toString(), own = webview.cspSource;
    const shape = vscode.workspace.getConfiguration("mxgen").get("shape", "ball");
    return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src ${own} 'wasm-unsafe-eval'; style-src ${own}; connect-src ${own}; img-src blob:; worker-src blob:">
<title>Preview</title>
<link rel="stylesheet" href="${address("view.css")}">
</head>
<body data-wasm="${address("mxgen.wasm")}" data-shape="${shape}">
<script src="${address("view.js")}"></script>
</body>
</html>
`;
}
