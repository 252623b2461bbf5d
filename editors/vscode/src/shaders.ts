// SPDX-License-Identifier: Apache-2.0
// Shaders and explanations as read-only documents. A shader follows its MaterialX document.

import type { Shader, Target } from "mxgen";
import { DocumentError } from "mxgen";
import * as vscode from "vscode";

import type { Compiler } from "./compiler";

export const SHADER = "mxgen-shader", MESSAGE = "mxgen-message";
const PAUSE = 400; // milliseconds after a key before shaders that are open are made anew

interface Request {
    source: string;
    element: string;
    target: string;
}

const requestOf = (uri: vscode.Uri): Request => JSON.parse(uri.query);

function textOf(shader: Shader): string {
    return shader.parts.length ? shader.parts.map(({ source }) => source).join("\n") : shader.pixel ?? shader.vertex ?? "";
}

/** The address of a shader; its name ends as the file that `mxgen` writes. */
function shaderUri(request: Request, target: Target): vscode.Uri {
    const name = request.element.split("/").at(-1), suffix = target.suffixes.pixel ?? target.suffixes.vertex ?? "";
    return vscode.Uri.from({ scheme: SHADER, path: `/${request.target}/${name}.${suffix}`, query: JSON.stringify(request) });
}

export class Shaders implements vscode.TextDocumentContentProvider, vscode.Disposable {
    readonly #changes = new vscode.EventEmitter<vscode.Uri>();
    readonly onDidChange = this.#changes.event;
    readonly #timers = new Map<string, NodeJS.Timeout>();
    readonly #listener: vscode.Disposable;

    constructor(private readonly compiler: Compiler) {
        this.#listener = vscode.workspace.onDidChangeTextDocument(({ document }) => this.#follow(document.uri.toString()));
    }

    #follow(source: string): void {
        clearTimeout(this.#timers.get(source));
        this.#timers.set(source, setTimeout(() => {
            this.#timers.delete(source);
            for (const { uri } of vscode.workspace.textDocuments)
                if (uri.scheme === SHADER && requestOf(uri).source === source)
                    this.#changes.fire(uri);
        }, PAUSE));
    }

    async provideTextDocumentContent(uri: vscode.Uri): Promise<string> {
        const { source, element, target } = requestOf(uri);
        const document = await vscode.workspace.openTextDocument(vscode.Uri.parse(source));
        return this.compiler.withDocument(document, (parsed, diagnostics) => {
            if (!parsed)
                return `// The document is no XML: ${diagnostics[0]?.message ?? ""}\n`;
            try {
                const shader = parsed.generate(target, { element });
                try {
                    return textOf(shader);
                } finally {
                    shader.destroy();
                }
            } catch (error) {
                if (!(error instanceof DocumentError))
                    throw error;
                return error.message.replace(/^/gm, "// ") + "\n";
            }
        });
    }

    /** Opens a shader beside the text; asks for what the request leaves open. */
    async open(source: vscode.TextDocument, { element, target }: Partial<Request> = {}): Promise<void> {
        const { targets } = await this.compiler.mxgen();
        const chosen = target ?? (await vscode.window.showQuickPick(targets.map(({ name, brief }) => ({ label: name, detail: brief })), { title: "Target" }))?.label;
        const found = targets.find(({ name }) => name === chosen);
        if (!found)
            return;
        const path = element ?? await this.#pickElement(source);
        if (!path)
            return;
        const shown = await vscode.workspace.openTextDocument(shaderUri({ source: source.uri.toString(), element: path, target: found.name }, found));
        await vscode.window.showTextDocument(shown, { viewColumn: vscode.ViewColumn.Beside, preview: true, preserveFocus: true });
    }

    async #pickElement(source: vscode.TextDocument): Promise<string | undefined> {
        const renderables = await this.compiler.withDocument(source, document => document?.renderables ?? []);
        if (!renderables.length)
            void vscode.window.showWarningMessage("The document has nothing to make a shader of: no material, and no output of a graph.");
        if (renderables.length <= 1)
            return renderables[0]?.path;
        return (await vscode.window.showQuickPick(renderables.map(({ path, type }) => ({ label: path, description: type })), { title: "Element" }))?.label;
    }

    dispose(): void {
        for (const timer of this.#timers.values())
            clearTimeout(timer);
        this.#listener.dispose();
        this.#changes.dispose();
    }
}

/** Explains messages: cause, cure and example, as in `mxgen explain`. */
export class Messages implements vscode.TextDocumentContentProvider {
    constructor(private readonly compiler: Compiler) {}

    async provideTextDocumentContent(uri: vscode.Uri): Promise<string> {
        const id = uri.path.replace(/^\/|\.md$/g, ""), { diagnosticKinds } = await this.compiler.mxgen(), kind = diagnosticKinds.find(one => one.id === id);
        if (!kind)
            return `mxgen has no message \`${id}\`.\n`;
        const example = kind.example && `\n\`\`\`diff\n${kind.example.trimEnd()}\n\`\`\`\n`;
        return `# ${kind.id}\n\n*${kind.severity}*: ${kind.message}\n\n**Cause.** ${kind.cause}\n\n**Cure.** ${kind.cure}\n${example}`;
    }

    /** Shows an explanation; without `id` somebody picks it, those of messages at the cursor first. */
    async show(id?: string): Promise<void> {
        const chosen = id ?? await this.#pick();
        if (chosen)
            await vscode.commands.executeCommand("markdown.showPreview", vscode.Uri.from({ scheme: MESSAGE, path: `/${chosen}.md` }));
    }

    async #pick(): Promise<string | undefined> {
        const editor = vscode.window.activeTextEditor, here = new Set<string>();
        if (editor)
            for (const { range, code } of vscode.languages.getDiagnostics(editor.document.uri))
                if (range.intersection(editor.selection))
                    here.add(String(typeof code === "object" ? code.value : code));
        const kinds = [...(await this.compiler.mxgen()).diagnosticKinds].sort((a, b) => Number(here.has(b.id)) - Number(here.has(a.id)));
        const items = kinds.map(({ id: label, cause }) => ({ label, description: here.has(label) ? "at the cursor" : "", detail: cause }));
        return (await vscode.window.showQuickPick(items, { title: "Message", matchOnDetail: true }))?.label;
    }
}
