// SPDX-License-Identifier: Apache-2.0
// Messages and formatting by the module of WebAssembly, where no language server runs: in the browser, and without the program.

import type { Diagnostic } from "mxgen";
import { DocumentError } from "mxgen";
import * as vscode from "vscode";

import type { Compiler } from "./compiler";
import { offsetOf } from "./text";

const PAUSE = 300; // milliseconds after a key before the document is checked
const SEVERITIES = { error: vscode.DiagnosticSeverity.Error, warning: vscode.DiagnosticSeverity.Warning, note: vscode.DiagnosticSeverity.Information };

function rangeOf(document: vscode.TextDocument, { line, column, length }: Diagnostic): vscode.Range {
    const text = document.getText(), start = offsetOf(text, line, column), units = [...text.slice(start, start + 2 * length)].slice(0, length).join("").length;
    return new vscode.Range(document.positionAt(start), document.positionAt(start + units));
}

function shown(document: vscode.TextDocument, found: Diagnostic[]): vscode.Diagnostic[] {
    const own = document.uri.toString(), messages = new Map<number, vscode.Diagnostic>();
    found.forEach((item, index) => {
        const place = item.file === own && item.line > 0 ? rangeOf(document, item) : new vscode.Range(0, 0, 0, 0), parent = messages.get(item.parent);
        if (item.severity === "note" && parent) {
            (parent.relatedInformation ??= []).push(new vscode.DiagnosticRelatedInformation(new vscode.Location(document.uri, place), item.message));
            return;
        }
        const message = new vscode.Diagnostic(place, item.message, SEVERITIES[item.severity]);
        messages.set(index, Object.assign(message, { source: "mxgen", code: item.id }));
    });
    return [...messages.values()];
}

async function format(compiler: Compiler, document: vscode.TextDocument): Promise<vscode.TextEdit[]> {
    try {
        const text = await compiler.format(document), whole = new vscode.Range(new vscode.Position(0, 0), document.positionAt(document.getText().length));
        return text === document.getText() ? [] : [vscode.TextEdit.replace(whole, text)];
    } catch (error) {
        if (!(error instanceof DocumentError))
            throw error;
        return []; // the messages tell why
    }
}

export function startBuiltin(compiler: Compiler): vscode.Disposable {
    const collection = vscode.languages.createDiagnosticCollection("mxgen"), timers = new Map<vscode.TextDocument, NodeJS.Timeout>();
    const check = async (document: vscode.TextDocument) => {
        timers.delete(document);
        // Of the second list notes come with their messages, too.
        const { version } = document, found = await compiler.withDocument(document, (parsed, diagnostics) =>
            shown(document, parsed && !diagnostics.length ? [...parsed.validate()] : diagnostics));
        if (!document.isClosed && document.version === version)
            collection.set(document.uri, found);
    };
    const later = (document: vscode.TextDocument, pause: number) => {
        if (document.languageId !== "materialx")
            return;
        clearTimeout(timers.get(document));
        timers.set(document, setTimeout(() => void check(document), pause));
    };
    vscode.workspace.textDocuments.forEach(document => later(document, 0));
    return vscode.Disposable.from(collection,
        vscode.workspace.onDidOpenTextDocument(document => later(document, 0)),
        vscode.workspace.onDidChangeTextDocument(({ document }) => later(document, PAUSE)),
        vscode.workspace.onDidCloseTextDocument(document => {
            clearTimeout(timers.get(document));
            timers.delete(document);
            collection.delete(document.uri);
        }),
        vscode.languages.registerDocumentFormattingEditProvider("materialx", { provideDocumentFormattingEdits: document => format(compiler, document) }));
}
